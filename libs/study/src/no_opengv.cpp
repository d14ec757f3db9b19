// SPDX-License-Identifier: BSD-3-Clause
#include "peers.h"

namespace vmcl {

bool hasOpenGv() { return false; }

std::vector<PoseMethod> openGvMethods() { return {}; }

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "verbs.h"

namespace vmcl {

void addMapVerb(CLI::App&, int&) {}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "verbs.h"

namespace vmcl {

void addSimulateVerb(CLI::App&, int&) {}

}  // namespace vmcl

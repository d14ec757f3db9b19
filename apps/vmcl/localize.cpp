// SPDX-License-Identifier: BSD-3-Clause
#include "verbs.h"

namespace vmcl {

void addLocalizeVerb(CLI::App&, int&) {}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// Says that a ground truth covers none of the times of a log from first to last (s), and which it does: as when it is
/// that of another log.
std::string coversNothing(const Trajectory& ground_truth, double first, double last);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// The poses of the robot in the frame of its odometry, from the CObservationOdometry of a log. Readings that are not
/// finite or not newer than the one before are left out; a log that is cut off is good up to there. Throws
/// std::runtime_error naming the log when it has none.
Trajectory readOdometry(const std::filesystem::path& rawlog);

}  // namespace vmcl

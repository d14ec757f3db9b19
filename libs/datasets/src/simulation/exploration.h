// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drive.h"
#include "floor_plan.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// The true path of a robot that drives to one random place after the other, around what stands in its way, for
/// `duration` seconds; without a start it begins somewhere in the largest closed part of the plan. Never touches
/// anything. Throws std::runtime_error when there is no room to drive.
Trajectory explore(const RobotModel& robot, const FloorPlan& plan, const std::optional<PlanarPose>& start,
                   double start_time, double duration, Random& random);

}  // namespace vmcl

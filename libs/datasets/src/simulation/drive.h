// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene.h"
#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// A differential-drive robot: a disc of this radius and height.
struct RobotModel {
  double radius = 0.2;                 ///< m
  double height = 0.5;                 ///< m
  double max_speed = 0.5;              ///< m/s
  double max_turn_rate = 0.8;          ///< rad/s
  double max_acceleration = 0.6;       ///< m/s^2
  double max_turn_acceleration = 2.0;  ///< rad/s^2
};

/// The true path of a robot that drives from waypoint to waypoint, cutting corners smoothly, and stops at the last;
/// 100 poses a second from `start_time` (s) on, at most `duration` seconds. Throws std::runtime_error naming the
/// waypoint that is not reached.
Trajectory driveThrough(const RobotModel& robot, const PlanarPose& start, const std::vector<Eigen::Vector2d>& waypoints,
                        double start_time, double duration);

/// Throws std::runtime_error saying where the robot would touch what.
void checkPathIsFree(const Trajectory& path, const RobotModel& robot, const std::vector<Solid>& solids);

}  // namespace vmcl

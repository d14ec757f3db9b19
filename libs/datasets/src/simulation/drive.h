// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "floor_plan.h"
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

/// A place to drive to, and how fast at most on the way there (m/s, no limit of its own: 0).
struct Waypoint {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double max_speed = 0;
};

/// The true path of a robot that drives from waypoint to waypoint, cutting corners smoothly, and stops at the last;
/// 100 poses a second from `start_time` (s) on, at most `duration` seconds. Throws std::runtime_error naming the
/// waypoint that is not reached.
Trajectory driveThrough(const RobotModel& robot, const PlanarPose& start, const std::vector<Waypoint>& waypoints,
                        double start_time, double duration);

/// The first pose at which the robot would touch something, if it would.
std::optional<StampedPose> obstacleOf(const Trajectory& path, const RobotModel& robot, const FloorPlan& plan);

/// Throws std::runtime_error saying where the robot would touch what.
void checkPathIsFree(const Trajectory& path, const RobotModel& robot, const FloorPlan& plan,
                     const std::vector<Object>& objects);

}  // namespace vmcl

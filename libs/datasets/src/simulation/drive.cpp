// SPDX-License-Identifier: BSD-3-Clause
#include "drive.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace vmcl {
namespace {

using Eigen::Vector2d;

constexpr double step = 0.01;           // s
constexpr double arrived = 0.15;        // m from a waypoint
constexpr double max_leg_time = 120.0;  // s to a waypoint; more means going around it in circles
constexpr double heading_gain = 2.5;    // turn rate per heading error (1/s)

struct Motion {
  double speed = 0;
  double turn_rate = 0;
};

double approached(double value, double target, double max_change) {
  return value + std::clamp(target - value, -max_change, max_change);
}

/// The motion after one more step towards `goal`; the robot slows down to turn, and to stop if the goal is the last.
Motion steer(const RobotModel& robot, const PlanarPose& pose, const Motion& motion, const Waypoint& goal, bool last) {
  const Vector2d way = goal.place - Vector2d(pose.x, pose.y);
  const double error = wrapAngle(std::atan2(way.y(), way.x()) - pose.phi);
  double speed = robot.max_speed * std::pow(std::max(0.0, std::cos(error)), 3);
  if (goal.max_speed > 0) speed = std::min(speed, goal.max_speed);
  if (last) speed = std::min(speed, std::sqrt(2 * 0.5 * robot.max_acceleration * way.norm()));
  const double turn_rate = std::clamp(heading_gain * error, -robot.max_turn_rate, robot.max_turn_rate);
  return {approached(motion.speed, speed, robot.max_acceleration * step),
          approached(motion.turn_rate, turn_rate, robot.max_turn_acceleration * step)};
}

/// Along the arc of a constant motion.
PlanarPose advanced(const PlanarPose& pose, const Motion& motion) {
  const double turn = motion.turn_rate * step, way = motion.speed * step;
  return pose * PlanarPose{way * std::cos(turn / 2), way * std::sin(turn / 2), turn};
}

std::string text(const char* format, double a, double b, double c = 0) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

}  // namespace

Trajectory driveThrough(const RobotModel& robot, const PlanarPose& start, const std::vector<Waypoint>& waypoints,
                        double start_time, double duration) {
  std::vector<StampedPose> poses{{start_time, toRigid3(start)}};
  PlanarPose pose = start;
  Motion motion;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const std::size_t leg_start = poses.size();
    while ((waypoints[i].place - Vector2d(pose.x, pose.y)).norm() > arrived) {
      const double elapsed = static_cast<double>(poses.size()) * step;
      if (elapsed > duration) return Trajectory(poses);
      if (static_cast<double>(poses.size() - leg_start) * step > max_leg_time)
        throw std::runtime_error(
            text("waypoint [%.2f, %.2f] is not reached", waypoints[i].place.x(), waypoints[i].place.y()));
      motion = steer(robot, pose, motion, waypoints[i], i + 1 == waypoints.size());
      pose = advanced(pose, motion);
      poses.push_back({start_time + elapsed, toRigid3(pose)});
    }
  }
  return Trajectory(poses);
}

std::optional<StampedPose> obstacleOf(const Trajectory& path, const RobotModel& robot, const FloorPlan& plan) {
  for (const StampedPose& pose : path.poses())
    if (plan.clearance(pose.map_from_robot.translation().head<2>()) + plan.cell() / 2 < robot.radius) return pose;
  return std::nullopt;
}

void checkPathIsFree(const Trajectory& path, const RobotModel& robot, const FloorPlan& plan,
                     const std::vector<Object>& objects) {
  const auto obstacle = obstacleOf(path, robot, plan);
  if (!obstacle) return;
  const Vector2d center = obstacle->map_from_robot.translation().head<2>();
  throw std::runtime_error(
      "the path runs into " + objects.at(plan.nearestObject(center).value()).name +
      text(" at [%.2f, %.2f] after %.1f s", center.x(), center.y(), obstacle->time - path.poses().front().time));
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/drive.h"

#include <gtest/gtest.h>

#include <limits>

#include "simulation/shapes.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
constexpr double forever = std::numeric_limits<double>::infinity();

TEST(DriveThrough, passesTheWaypointsAndStopsAtTheLast) {
  const std::vector<Waypoint> waypoints{{{2, 0}}, {{2, 2}}, {{0, 2}}};
  const auto path = driveThrough({}, {}, waypoints, 100, forever).poses();
  for (const Waypoint& waypoint : waypoints) {
    double nearest = forever;
    for (const auto& pose : path)
      nearest = std::min(nearest, (pose.map_from_robot.translation().head<2>() - waypoint.place).norm());
    EXPECT_LT(nearest, 0.16);
  }
  EXPECT_EQ(path.front().time, 100);
  EXPECT_LT((path.back().map_from_robot.translation().head<2>() - waypoints.back().place).norm(), 0.16);
}

TEST(DriveThrough, keepsItsLimitsAndMovesAlongItsHeading) {
  const RobotModel robot;
  const auto path = driveThrough(robot, {0, 0, 2}, {{{1, 0}}, {{1, -1}}, {{-2, 1}}}, 0, forever).poses();
  double last_speed = 0, last_turn_rate = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double dt = path[i].time - path[i - 1].time;
    const PlanarPose motion = planarPart(path[i - 1].map_from_robot.inverse() * path[i].map_from_robot);
    const double speed = motion.x / dt, turn_rate = motion.phi / dt;
    ASSERT_NEAR(dt, 0.01, 1e-9);
    EXPECT_GE(speed, -1e-6);
    EXPECT_LE(speed, robot.max_speed + 1e-6);
    EXPECT_LE(std::abs(turn_rate), robot.max_turn_rate + 1e-6);
    EXPECT_LE(std::abs(speed - last_speed), robot.max_acceleration * dt + 1e-5);
    EXPECT_LE(std::abs(turn_rate - last_turn_rate), robot.max_turn_acceleration * dt + 1e-5);
    EXPECT_NEAR(motion.y, motion.x * std::tan(motion.phi / 2), 1e-9);  // an arc: wheels do not slip sideways
    last_speed = speed;
    last_turn_rate = turn_rate;
  }
}

TEST(DriveThrough, endsWithTheDuration) {
  const auto path = driveThrough({}, {}, {{{50, 0}}}, 0, 3).poses();
  EXPECT_NEAR(path.back().time, 3, 0.011);
}

TEST(DriveThrough, refusesAWaypointItCannotReach) {
  EXPECT_THROW(driveThrough({.max_speed = 0.01}, {}, {{{50, 0}}}, 0, forever), std::runtime_error);
}

TEST(DriveThrough, heedsTheSpeedLimitOfAWaypoint) {
  const auto path = driveThrough({}, {}, {{{2, 0}, 0.2}, {{4, 0}}}, 0, forever);
  const auto speedAt = [&](double x) {
    for (std::size_t i = 1; i < path.poses().size(); ++i)
      if (path.poses()[i].map_from_robot.translation().x() > x)
        return (path.poses()[i].map_from_robot.translation() - path.poses()[i - 1].map_from_robot.translation())
                   .norm() /
               0.01;
    return 0.0;
  };
  EXPECT_NEAR(speedAt(1), 0.2, 1e-6);
  EXPECT_NEAR(speedAt(3), RobotModel().max_speed, 1e-6);
}

TEST(CheckPathIsFree, saysWhereTheRobotTouchesWhat) {
  const auto path = driveThrough({}, {}, {{{3, 0}}}, 0, forever);
  const auto check = [&](double bottom, const RobotModel& robot) {
    Scene scene;
    addBox(scene, scene.addObject("table"), {{2, 0.5, 0}, {0.3, 0.35}, bottom, 0.7}, {"plain", {}}, {});
    checkPathIsFree(path, robot, FloorPlan(trianglesOf(scene), robot.height), scene.objects);
  };
  try {
    check(0, {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("the path runs into table at [1."), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(check(0, {.radius = 0.1}));
  EXPECT_NO_THROW(check(0.6, {}));  // the robot passes below
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser_scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/shapes.h"

namespace vmcl {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Triangle> boxes(const std::vector<Solid>& solids) {
  Scene scene;
  for (const Solid& solid : solids) addBox(scene, scene.addObject("box"), solid, {"plain", {}}, {});
  return trianglesOf(scene);
}

/// A room of 6 m x 4 m around the origin, of four walls 0.2 m thick.
std::vector<Triangle> room() {
  return boxes({{{3.1, 0, 0}, {0.1, 2.2}, 0, 2},
                {{-3.1, 0, 0}, {0.1, 2.2}, 0, 2},
                {{0, 2.1, 0}, {3.2, 0.1}, 0, 2},
                {{0, -2.1, 0}, {3.2, 0.1}, 0, 2}});
}

/// Closed form: the nearer of the two walls that the ray heads for.
double distanceInRoom(const PlanarPose& ray) {
  const double c = std::cos(ray.phi), s = std::sin(ray.phi);
  return std::min((std::copysign(3, c) - ray.x) / c, (std::copysign(2, s) - ray.y) / s);
}

Rigid3 at(const PlanarPose& place, double height) {
  Rigid3 pose = toRigid3(place);
  pose.translation().z() = height;
  return pose;
}

double distance(const std::vector<Triangle>& triangles, const PlanarPose& ray, double height = 0.3) {
  LaserSweep sweep({.rays = 1}, at(ray, height));
  sweep.add(triangles);
  return sweep.distances().front();
}

std::vector<std::optional<double>> scanOf(const std::vector<Triangle>& triangles, const LaserModel& laser,
                                          const PlanarPose& place, Random& random) {
  LaserSweep sweep(laser, at(place, 0.3));
  sweep.add(triangles);
  return sweep.measure(random);
}

TEST(LaserSweep, agreesWithTheClosedFormInARoom) {
  Random random(3);
  const auto walls = room();
  for (int i = 0; i < 50; ++i) {
    const PlanarPose place{random.uniform(-2.9, 2.9), random.uniform(-1.9, 1.9), random.uniform(-pi, pi)};
    const LaserModel laser{.rays = 721, .aperture = 2 * pi};
    LaserSweep sweep(laser, at(place, 0.3));
    sweep.add(walls);
    for (int ray = 0; ray < laser.rays; ++ray)
      ASSERT_NEAR(sweep.distances()[ray], distanceInRoom(place * PlanarPose{0, 0, laser.angle(ray)}), 1e-9);
  }
}

TEST(LaserSweep, hitsTurnedBoxesAtTheirFaces) {
  const auto box = boxes({{{2, 0, pi / 4}, {0.5, 0.5}, 0, 1}});
  EXPECT_NEAR(distance(box, {0, 0, 0}), 2 - std::sqrt(0.5), 1e-9);
  EXPECT_TRUE(std::isinf(distance(box, {0, 0.75, 0})));
  EXPECT_TRUE(std::isinf(distance(box, {0, 0, pi})));
}

TEST(LaserSweep, passesUnderAndOverThings) {
  const auto shelf = boxes({{{2, 0, 0}, {0.5, 0.5}, 0.5, 1}});
  EXPECT_TRUE(std::isinf(distance(shelf, {}, 0.4)));
  EXPECT_NEAR(distance(shelf, {}, 0.6), 1.5, 1e-9);
  EXPECT_TRUE(std::isinf(distance(shelf, {}, 1.1)));
}

TEST(LaserSweep, aTiltedLaserSeesTheFloor) {
  Scene scene;
  addSide(scene, scene.addObject("floor"), {{0, 0, 0}, {20, 20}, -0.1, 0}, Side::top, {"plain", {}});
  Rigid3 pose = at({}, 0.3);
  pose.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));  // nose down
  LaserSweep sweep({.rays = 1}, pose);
  sweep.add(trianglesOf(scene));
  EXPECT_NEAR(sweep.distances().front(), 0.3 / std::sin(0.1), 1e-9);
}

TEST(LaserSweep, runsFromRightToLeftAndDropsFarReadings) {
  Random random(1);
  const LaserModel laser{.rays = 5, .aperture = pi, .max_range = 2.5, .sigma = 0};
  const auto ranges = scanOf(room(), laser, {0.5, 0, 0}, random);
  ASSERT_EQ(ranges.size(), 5u);
  EXPECT_NEAR(ranges[0].value(), 2, 1e-9);  // right: south
  EXPECT_FALSE(ranges[1]);                  // south-east corner is 2.8 m away
  EXPECT_NEAR(scanOf(room(), laser, {0.7, 0, 0}, random)[2].value(), 2.3, 1e-9);
  EXPECT_NEAR(ranges[4].value(), 2, 1e-9);
}

TEST(LaserSweep, noiseHasTheGivenDeviation) {
  Random random(5);
  const LaserModel laser{.rays = 1, .sigma = 0.05};
  const auto walls = room();
  constexpr int count = 4000;
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < count; ++i) {
    const double error = scanOf(walls, laser, {}, random)[0].value() - 3;
    sum += error;
    sum_of_squares += error * error;
  }
  // Both within five standard errors: a false alarm for one seed in a million.
  EXPECT_NEAR(sum / count, 0, 5 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 0.05, 5 * 0.05 / std::sqrt(2.0 * count));
}

}  // namespace
}  // namespace vmcl

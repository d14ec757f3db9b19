// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser_scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

constexpr double pi = std::numbers::pi;

/// A room of 6 m x 4 m around the origin, of four walls 0.2 m thick.
std::vector<Solid> room() {
  return {{"east", {3.1, 0, 0}, {0.1, 2.2}, 0, 2},
          {"west", {-3.1, 0, 0}, {0.1, 2.2}, 0, 2},
          {"north", {0, 2.1, 0}, {3.2, 0.1}, 0, 2},
          {"south", {0, -2.1, 0}, {3.2, 0.1}, 0, 2}};
}

/// Closed form: the nearer of the two walls that the ray heads for.
double distanceInRoom(const PlanarPose& ray) {
  const double c = std::cos(ray.phi), s = std::sin(ray.phi);
  return std::min((std::copysign(3, c) - ray.x) / c, (std::copysign(2, s) - ray.y) / s);
}

TEST(CastRay, agreesWithTheClosedFormInARoom) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const PlanarPose ray{random.uniform(-2.9, 2.9), random.uniform(-1.9, 1.9), random.uniform(-pi, pi)};
    const auto range = castRay(room(), ray, 0.3);
    ASSERT_TRUE(range);
    EXPECT_NEAR(*range, distanceInRoom(ray), 1e-9);
  }
}

TEST(CastRay, hitsTurnedBoxesAtTheirFaces) {
  const Solid box{"box", {2, 0, pi / 4}, {0.5, 0.5}, 0, 1};
  EXPECT_NEAR(castRay({box}, {0, 0, 0}, 0.3).value(), 2 - std::sqrt(0.5), 1e-12);
  EXPECT_FALSE(castRay({box}, {0, 0.75, 0}, 0.3));
  EXPECT_FALSE(castRay({box}, {0, 0, pi}, 0.3));
  EXPECT_EQ(castRay({box}, {2, 0, 0}, 0.3).value(), 0);
}

TEST(CastRay, passesUnderAndOverSolids) {
  const Solid shelf{"shelf", {2, 0, 0}, {0.5, 0.5}, 0.5, 1};
  EXPECT_FALSE(castRay({shelf}, {0, 0, 0}, 0.4));
  EXPECT_TRUE(castRay({shelf}, {0, 0, 0}, 0.6));
  EXPECT_FALSE(castRay({shelf}, {0, 0, 0}, 1.1));
}

TEST(Scan, runsFromRightToLeftAndDropsFarReadings) {
  Random random(1);
  const LaserModel laser{.rays = 5, .aperture = pi, .max_range = 2.5, .sigma = 0};
  const auto ranges = scan(room(), laser, {0.5, 0, 0}, 0.3, random);
  ASSERT_EQ(ranges.size(), 5u);
  EXPECT_NEAR(ranges[0].value(), 2, 1e-9);  // right: south
  EXPECT_FALSE(ranges[1]);                  // south-east corner is 2.8 m away
  EXPECT_NEAR(scan(room(), laser, {0.7, 0, 0}, 0.3, random)[2].value(), 2.3, 1e-9);
  EXPECT_NEAR(ranges[4].value(), 2, 1e-9);
}

TEST(Scan, noiseHasTheGivenDeviation) {
  Random random(5);
  const LaserModel laser{.rays = 1, .sigma = 0.05};
  constexpr int count = 4000;
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < count; ++i) {
    const double error = scan(room(), laser, {0, 0, 0}, 0.3, random)[0].value() - 3;
    sum += error;
    sum_of_squares += error * error;
  }
  // Both within five standard errors: a false alarm for one seed in a million.
  EXPECT_NEAR(sum / count, 0, 5 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 0.05, 5 * 0.05 / std::sqrt(2.0 * count));
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/wheel_odometry.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vmcl {
namespace {

TEST(WheelOdometry, withoutNoiseItIsTheMotionSinceTheStart) {
  const PlanarPose start{3, -2, 1};
  WheelOdometry odometry({0, 0, 0, 0}, Random(1));
  odometry.read(start);
  PlanarPose reading;
  for (int i = 1; i <= 50; ++i) reading = odometry.read(start * PlanarPose{0.02 * i, 0, 0.03 * i});
  EXPECT_NEAR(reading.x, 1, 1e-9);
  EXPECT_NEAR(reading.y, 0, 1e-9);
  EXPECT_NEAR(reading.phi, 1.5, 1e-9);
}

TEST(WheelOdometry, standingStillDoesNotDrift) {
  WheelOdometry odometry({1, 1, 1, 1}, Random(1));
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(odometry.read({1, 2, 3}).x, 0, 1e-6);
}

struct Deviation {
  double way = 0;
  double heading = 0;
};

/// Over many runs, of a drive straight on (m) or a turn on the spot (rad), read in so many steps.
Deviation deviationAfter(double way, double turn, int steps) {
  constexpr int runs = 3000;
  Deviation sum;
  for (int run = 0; run < runs; ++run) {
    WheelOdometry odometry({.alpha1 = 0.002, .alpha2 = 0.0005, .alpha3 = 0.001, .alpha4 = 0.0002},
                           Random(11, static_cast<uint64_t>(run)));
    PlanarPose reading = odometry.read({});
    double along = 0;
    for (int i = 1; i <= steps; ++i) {
      const PlanarPose before = reading;
      reading = odometry.read({way * i / steps, 0, turn * i / steps});
      along += (inverse(before) * reading).x;
    }
    sum.way += (along - way) * (along - way);
    sum.heading += (reading.phi - turn) * (reading.phi - turn);
  }
  return {std::sqrt(sum.way / runs), std::sqrt(sum.heading / runs)};
}

/// Five standard errors of a deviation found from 3000 runs: a false alarm for one seed in a million and test.
double tolerance(double deviation) { return 5 * deviation / std::sqrt(2.0 * 3000); }

TEST(WheelOdometry, errsByItsAlphasHoweverOftenItIsRead) {
  for (const int steps : {5, 80}) {
    const Deviation straight = deviationAfter(4, 0, steps);
    EXPECT_NEAR(straight.way, std::sqrt(0.001 * 4), tolerance(straight.way));
    EXPECT_NEAR(straight.heading, std::sqrt(0.0005 * 4), tolerance(straight.heading));
    const Deviation turn = deviationAfter(0, 2, steps);
    EXPECT_NEAR(turn.way, std::sqrt(0.0002 * 2), tolerance(turn.way));
    EXPECT_NEAR(turn.heading, std::sqrt(0.002 * 2), tolerance(turn.heading));
  }
}

TEST(WheelOdometry, aSlipCountsWayAndTurnTooMuch) {
  // No other noise: after 100 m with about 30 slips of 4 cm on average, each half of it on the way.
  WheelOdometry odometry({.alpha1 = 0, .alpha2 = 0, .alpha3 = 0, .alpha4 = 0, .slips_per_m = 0.3, .slip = 0.05},
                         Random(3));
  PlanarPose last = odometry.read({});
  double way = 0, turned = 0;
  int slips = 0;
  bool slipping = false;
  for (int i = 1; i <= 10000; ++i) {
    const PlanarPose reading = odometry.read({0.01 * i, 0, 0}), motion = inverse(last) * reading;
    way += motion.x;
    turned += std::abs(motion.phi);
    const bool slipped = std::abs(motion.phi) > 1e-9;
    slips += slipped && !slipping;  // two that follow on one another count once
    slipping = slipped;
    EXPECT_LE(motion.x, 0.01 * 1.25 + 1e-9);  // a slipping wheel counts half as much again
    last = reading;
  }
  EXPECT_NEAR(slips, 30, 5 * std::sqrt(30.0));  // a Poisson count within five deviations
  EXPECT_NEAR(way - 100, turned * 0.3 / 2, 1e-6);
  EXPECT_GT(way, 100.1);
}

TEST(WheelOdometry, alpha5DriftsSideways) {
  double sum_of_squares = 0;
  constexpr int runs = 2000;
  for (int run = 0; run < runs; ++run) {
    WheelOdometry odometry({.alpha1 = 0, .alpha2 = 0, .alpha3 = 0, .alpha4 = 0, .alpha5 = 0.01},
                           Random(5, static_cast<uint64_t>(run)));
    odometry.read({});
    const double drift = odometry.read({2, 0, 0}).y;
    sum_of_squares += drift * drift;
  }
  EXPECT_NEAR(sum_of_squares / runs, 0.02, 5 * 0.02 * std::sqrt(2.0 / runs));  // within five standard errors
}

}  // namespace
}  // namespace vmcl

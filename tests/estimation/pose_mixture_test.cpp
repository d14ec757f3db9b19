// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_mixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vmcl {
namespace {

PoseMode mode(double x, double log_evidence, double sigma = 0.01) {
  PoseMode result;
  result.robot_in_map = {x, 0, 3.14};
  result.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
  result.log_evidence = log_evidence;
  return result;
}

TEST(PoseMixture, DifferenceWrapsTheAngle) {
  EXPECT_NEAR(difference({0, 0, -3.1}, {0, 0, 3.1}).z(), 2 * M_PI - 6.2, 1e-12);
}

TEST(PoseMixture, FloorsAreTwoPlaces) {
  PoseMode upstairs = mode(1, 11);
  upstairs.height = 3;
  EXPECT_EQ(mergeModes({mode(1, 10), upstairs}, 5).size(), 2u);
}

TEST(PoseMixture, AnyPeakCountsOnce) {
  const auto merged = mergeModes({mode(1, 10), mode(1.002, 12), mode(5, 11)}, 5);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].robot_in_map.x, 1.002);
  EXPECT_EQ(merged[0].log_evidence, 12);
  EXPECT_EQ(merged[0].covariance, mode(1, 0).covariance);
  EXPECT_EQ(merged[1].robot_in_map.x, 5);
}

// Two peaks 0.02 m apart, weights 3 : 1, across the seam of the angle.
TEST(PoseMixture, PeaksOfOnePlaceAreJoinedByMoments) {
  PoseMode other = mode(1.02, 10);
  other.robot_in_map.phi -= 2 * M_PI;
  const auto merged = mergeModes({mode(1, 10 + std::log(3.0)), other}, 5);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].robot_in_map.x, 1.005, 1e-12);
  EXPECT_NEAR(merged[0].robot_in_map.phi, 3.14, 1e-12);
  EXPECT_NEAR(merged[0].covariance(0, 0), 0.01 * 0.01 + 0.25 * 0.75 * 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(merged[0].covariance(1, 1), 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(merged[0].log_evidence, 10 + std::log(4.0), 1e-12);
}

TEST(PoseMixture, WeightsAreSharesOfTheEvidence) {
  const auto merged = mergeModes({mode(0, 10), mode(1, 11), mode(2, 9)}, 5);
  ASSERT_EQ(merged.size(), 3u);
  double sum = 0;
  for (const PoseMode& m : merged) sum += std::exp(m.log_weight);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(merged[0].robot_in_map.x, 1);
  EXPECT_NEAR(merged[0].log_weight - merged[1].log_weight, 1, 1e-9);
  EXPECT_NEAR(merged[0].log_weight - merged[2].log_weight, 2, 1e-9);
}

TEST(PoseMixture, KeepsTheHeaviest) {
  const auto merged = mergeModes({mode(0, 1), mode(1, 3), mode(2, 2)}, 2);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].robot_in_map.x, 1);
  EXPECT_EQ(merged[1].robot_in_map.x, 2);
  EXPECT_TRUE(mergeModes({}, 3).empty());
}

}  // namespace
}  // namespace vmcl

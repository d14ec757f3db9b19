// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_mixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vmcl {
namespace {

PoseMode mode(double x, double log_likelihood, double sigma = 0.01) {
  PoseMode result;
  result.robot_in_map = {x, 0, 3.14};
  result.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
  result.log_likelihood = log_likelihood;
  return result;
}

TEST(PoseMixture, DifferenceWrapsTheAngle) {
  EXPECT_NEAR(difference({0, 0, -3.1}, {0, 0, 3.1}).z(), 2 * M_PI - 6.2, 1e-12);
}

TEST(PoseMixture, MergesTheSameModeAndKeepsTheBetter) {
  const auto merged = mergeModes({mode(1, 10), mode(1.02, 12), mode(5, 11)}, 5);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].robot_in_map.x, 1.02);
  EXPECT_EQ(merged[1].robot_in_map.x, 5);
}

TEST(PoseMixture, WeightsAreLaplaceEvidenceAndSumToOne) {
  const auto merged = mergeModes({mode(0, 10, 0.01), mode(1, 10, 0.02), mode(2, 9, 0.02)}, 5);
  ASSERT_EQ(merged.size(), 3u);
  double sum = 0;
  for (const PoseMode& m : merged) sum += std::exp(m.log_weight);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(merged[0].robot_in_map.x, 1);
  EXPECT_NEAR(merged[0].log_weight - merged[1].log_weight, 1, 1e-9);              // same spread, one nat apart
  EXPECT_NEAR(merged[0].log_weight - merged[2].log_weight, std::log(8.0), 1e-9);  // twice the sigma, cubed
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/trajectory_error.h"

#include <gtest/gtest.h>

#include "straight_drive.h"

namespace vmcl {
namespace {

/// Estimates every 0.1 s that are off by (0, dy, dphi) from `converged` on and by 3 m before.
std::vector<TimedEstimate> estimates(double converged, double dy, double dphi) {
  std::vector<TimedEstimate> all;
  for (int i = 0; i <= 100; ++i) {
    const double t = i * 0.1;
    const bool good = t >= converged - 1e-9;
    all.push_back({t, good, {t, good ? dy : 3, good ? dphi : 0}});
  }
  return all;
}

TEST(TrajectoryError, StatisticsOfKnownNumbers) {
  const ErrorStatistics odd = statisticsOf({3, 1, 2});
  EXPECT_DOUBLE_EQ(odd.median, 2);
  EXPECT_DOUBLE_EQ(odd.max, 3);
  EXPECT_DOUBLE_EQ(odd.rmse, std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(statisticsOf({4, 1, 2, 3}).median, 2.5);
  EXPECT_EQ(statisticsOf({}).rmse, 0);
}

TEST(TrajectoryError, ConstantOffsetIsNotAlignedAway) {
  const auto result = evaluateTrajectory(estimates(0, 0.1, 2 * degree), straightDrive());
  EXPECT_EQ(result.compared, 101);
  EXPECT_EQ(result.localized, 101);
  EXPECT_EQ(result.false_accepts, 0);
  EXPECT_DOUBLE_EQ(result.success_share, 1);
  EXPECT_NEAR(result.position.rmse, 0.1, 1e-12);
  EXPECT_NEAR(result.position.median, 0.1, 1e-12);
  EXPECT_NEAR(result.heading.max, 2 * degree, 1e-12);
  ASSERT_TRUE(result.time_to_converge);
  EXPECT_DOUBLE_EQ(*result.time_to_converge, 0);
}

TEST(TrajectoryError, CountsTheTimeToConverge) {
  const auto result = evaluateTrajectory(estimates(4, 0.05, 0), straightDrive());
  ASSERT_TRUE(result.time_to_converge);
  EXPECT_NEAR(*result.time_to_converge, 4, 1e-9);
  EXPECT_NEAR(result.position_after.rmse, 0.05, 1e-12);
  EXPECT_EQ(result.localized, 61);
  EXPECT_NEAR(result.success_share, 61.0 / 101, 1e-12);
}

TEST(TrajectoryError, AShortSuccessIsNoConvergence) {
  auto lucky = estimates(6, 0.05, 0);
  lucky[10] = {1.0, true, {1.0, 0, 0}};  // one good estimate at 1 s, then wrong until 6 s
  const auto result = evaluateTrajectory(lucky, straightDrive());
  ASSERT_TRUE(result.time_to_converge);
  EXPECT_NEAR(*result.time_to_converge, 6, 1e-9);
}

TEST(TrajectoryError, FailureAfterConvergenceIsCounted) {
  auto lost = estimates(0, 0, 0);
  lost[80].robot_in_map.y = 2;
  const auto result = evaluateTrajectory(lost, straightDrive());
  EXPECT_EQ(result.false_accepts, 1);
  EXPECT_DOUBLE_EQ(result.position_after.max, 2);
  EXPECT_NEAR(result.position_after.rmse, 2 / std::sqrt(101.0), 1e-12);
}

TEST(TrajectoryError, ConfidentAndWrongIsAFalseAcceptAndNeverConverges) {
  const auto result = evaluateTrajectory(estimates(2, 1.2, 0), straightDrive());
  EXPECT_FALSE(result.time_to_converge);
  EXPECT_EQ(result.false_accepts, 81);
  EXPECT_EQ(result.position_after.rmse, 0);
}

TEST(TrajectoryError, HeadingIsComparedAcrossTheTurn) {
  const Trajectory truth({{0, toRigid3({0, 0, 179 * degree})}, {1, toRigid3({0, 0, 179 * degree})}});
  const auto error = poseError({0.5, true, {0, 0, -179 * degree}}, truth, 2);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->heading, 2 * degree, 1e-9);
}

TEST(TrajectoryError, OnlyTimesWithGroundTruthAreCompared) {
  const Trajectory truth({{0, toRigid3({})}, {1, toRigid3({})}, {5, toRigid3({})}});
  const std::vector<TimedEstimate> all{{-1, true, {}}, {0.5, true, {}}, {3, true, {}}, {6, true, {}}};
  EvaluationOptions options;
  options.max_gap = 2;
  const auto result = evaluateTrajectory(all, truth, options);
  EXPECT_EQ(result.estimates, 4);
  EXPECT_EQ(result.compared, 1);
}

TEST(TrajectoryError, RefusesBadOptions) {
  EvaluationOptions options;
  options.success_position = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

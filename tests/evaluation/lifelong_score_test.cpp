// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/lifelong_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "straight_drive.h"

namespace vmcl {
namespace {

// The ground truth lasts 10 s. From 2 to 4 s an estimate each 0.5 s, right but for the one at 3 s; then one at 8 s.
TEST(LifelongScore, OfASmallRun) {
  const std::vector<TimedEstimate> all{
      {0, false, {0, 0, 0}},    {2, true, {2, 0.9, 0}},         {2.5, true, {2.5, 0, 0}},      {3, true, {3, 1.1, 0}},
      {3.5, true, {3.5, 0, 0}}, {4, true, {4, 0, 29 * degree}}, {8, true, {8, 0, 31 * degree}}};
  const LifelongScore score = lifelongScore(all, straightDrive());
  EXPECT_NEAR(score.correct_rate, (0.5 + 0.5 + 0.5 + 1) / 10, 1e-12);
  EXPECT_DOUBLE_EQ(score.relocalization_time, 2);
  EXPECT_DOUBLE_EQ(score.relocalization_score, std::exp(-2.0 / 60));
}

TEST(LifelongScore, TheLastEstimateStandsNoLongerThanTheGroundTruth) {
  const std::vector<TimedEstimate> all{{9.75, true, {9.75, 0, 0}}};
  EXPECT_NEAR(lifelongScore(all, straightDrive()).correct_rate, 0.025, 1e-12);
}

TEST(LifelongScore, AFirstEstimateThatIsWrongScoresNothing) {
  const std::vector<TimedEstimate> all{{1, true, {3, 0, 0}}, {2, true, {2, 0, 0}}};
  EXPECT_EQ(lifelongScore(all, straightDrive()).relocalization_score, 0);
  EXPECT_DOUBLE_EQ(lifelongScore(all, straightDrive()).relocalization_time, 1);
}

TEST(LifelongScore, OfNoEstimate) {
  const std::vector<TimedEstimate> all{{1, false, {1, 0, 0}}, {-5, true, {0, 0, 0}}};
  const LifelongScore score = lifelongScore(all, straightDrive());
  EXPECT_EQ(score.correct_rate, 0);
  EXPECT_TRUE(std::isinf(score.relocalization_time));
  EXPECT_EQ(score.relocalization_score, 0);
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "error_curves.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

/// A run with an error each 0.1 s from `begin` on.
RunResult run(uint64_t seed, double begin, const std::vector<double>& positions, double heading = 0) {
  RunResult result;
  result.job.seed = seed;
  for (std::size_t i = 0; i < positions.size(); ++i)
    result.errors.push_back({begin + 0.1 * static_cast<double>(i), positions[i], heading});
  return result;
}

CellGroup groupOf(const std::vector<std::vector<const RunResult*>>& cells) {
  CellGroup group;
  for (const auto& runs : cells) group.cells.push_back({0, 0, {}, runs, 0, 0});
  return group;
}

TEST(ErrorCurves, QuartilesOverTheRuns) {
  std::vector<RunResult> runs;
  for (int i = 0; i < 5; ++i) runs.push_back(run(i, 10, {0.1 * i, 1.0 + i}));
  const ErrorGrid grid = errorGridOf(groupOf({{&runs[3], &runs[0], &runs[4], &runs[1], &runs[2]}}));
  const auto curve = quartilesOverTime(grid, 0);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_DOUBLE_EQ(curve[0].time, 0);
  EXPECT_EQ(curve[0].position, (std::array<double, 3>{0.1, 0.2, 0.1 * 3}));
  EXPECT_EQ(curve[1].position, (std::array<double, 3>{2, 3, 4}));
}

TEST(ErrorCurves, AnErrorStandsForASecondAtMost) {
  const RunResult early = run(1, 0, {0.1}), late = run(1, 2.05, {0.2});
  const ErrorGrid grid = errorGridOf(groupOf({{&early}, {&late}}));
  // 0, 0.1, ..., 1.0 s of the first run; 2.0 s is before the second one, whose time comes in no step
  EXPECT_EQ(grid.times.size(), 11U);
}

// Two methods, one seed, times 0 to 0.3 s. At 1 m the first succeeds at the first two times, the second at the second
// alone; at the last no one does.
TEST(ErrorCurves, SuccessIsNormalizedByTheBestOfTheMethods) {
  const RunResult one = run(1, 0, {0.1, 0.1, 2, 2}), other = run(1, 0, {2, 0.1, 0.1, 2});
  const ErrorGrid grid = errorGridOf(groupOf({{&one}, {&other}}));
  ASSERT_EQ(grid.times.size(), 4U);
  const SuccessRates rates = successRates(grid, 1);
  EXPECT_EQ(rates.absolute, (std::vector<double>{0.5, 0.5}));
  EXPECT_DOUBLE_EQ(rates.normalized[0], 2.0 / 3);
  EXPECT_EQ(successRates(grid, 0.05).normalized, (std::vector<double>{0, 0}));
}

TEST(ErrorCurves, SuccessNeedsTheHeadingToo) {
  const RunResult turned = run(1, 0, {0.1, 0.1}, 6 * degree);
  EXPECT_EQ(successRates(errorGridOf(groupOf({{&turned}})), 1).absolute, std::vector<double>{0});
}

TEST(ErrorCurves, ASeedThatAMethodLacksCountsAsItsFailure) {
  const RunResult one = run(1, 0, {0.1}), two = run(2, 0, {0.1});
  const SuccessRates rates = successRates(errorGridOf(groupOf({{&one, &two}, {&one}})), 1);
  EXPECT_EQ(rates.absolute, (std::vector<double>{1, 0.5}));
}

TEST(ErrorCurves, OfNoRun) {
  const ErrorGrid grid = errorGridOf(groupOf({{}}));
  EXPECT_TRUE(grid.times.empty());
}

}  // namespace
}  // namespace vmcl

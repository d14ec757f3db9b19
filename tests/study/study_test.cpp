// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace vmcl {
namespace {

PoseMethod fixedAnswer(const std::string& name, std::vector<PlanarPose> answer) {
  return {name, "", true, [answer](const PoseProblem&, const MethodSettings&) { return answer; }};
}

TEST(Study, CellsAreNumberedApartAndKeepTheirNumbers) {
  const auto all =
      studyCells({Figure::accuracy, Figure::success, Figure::tilt, Figure::cost_of_matches, Figure::cost_of_cameras});
  std::set<int> numbers;
  for (const StudyCell& cell : all) numbers.insert(cell.number);
  EXPECT_EQ(numbers.size(), all.size());
  const auto some = studyCells({Figure::success});
  ASSERT_EQ(some.size(), 72u);  // 3 worlds, 1 and 3 cameras, 4 outlier rates, 3 depth rates
  for (const StudyCell& cell : some) {
    EXPECT_EQ(cell.figure, Figure::success);
    EXPECT_EQ(all[std::size_t(cell.number)].world.outlier_rate, cell.world.outlier_rate);
    EXPECT_EQ(all[std::size_t(cell.number)].world.world, cell.world.world);
  }
}

TEST(Study, OneTrialGivesTheSameTwice) {
  const StudyCell cell = studyCells({Figure::success}).front();
  const auto methods = methodsOf(cell);
  const TrialResult once = runTrial(cell, methods, 5, 3), twice = runTrial(cell, methods, 5, 3),
                    other = runTrial(cell, methods, 6, 3);
  ASSERT_EQ(once.outcomes.size(), methods.size() + 1);
  for (std::size_t i = 0; i < once.outcomes.size(); ++i) {
    ASSERT_EQ(once.outcomes[i].error.has_value(), twice.outcomes[i].error.has_value());
    if (!once.outcomes[i].error) continue;
    EXPECT_EQ(once.outcomes[i].error->distance, twice.outcomes[i].error->distance);
  }
  ASSERT_TRUE(once.cramer_rao);
  EXPECT_EQ(once.cramer_rao->distance, twice.cramer_rao->distance);
  EXPECT_NE(once.cramer_rao->distance, other.cramer_rao->distance);
}

TEST(Study, MethodsAreToldTheNoise) {
  StudyCell cell;
  cell.world.noise_px = 5;
  EXPECT_EQ(settingsOf(cell, 0).sigma_px, 5);
  EXPECT_EQ(settingsOf(cell, 0).threshold_px, 20);
  EXPECT_EQ(settingsOf(cell, 0).seed, 1u);
  EXPECT_EQ(settingsOf(cell, 7).seed, 8u);
  cell.world.noise_px = 0;
  EXPECT_EQ(settingsOf(cell, 0).sigma_px, 0.5);
  EXPECT_EQ(settingsOf(cell, 0).threshold_px, 8);
}

TEST(Study, SummaryCountsWhatHappened) {
  const std::vector<PoseMethod> methods{fixedAnswer("a", {}), fixedAnswer("b", {})};
  const auto trial = [](std::optional<EstimationError> a, bool a_any, std::optional<EstimationError> b,
                        std::optional<EstimationError> c) {
    return TrialResult{{{a, a_any, 1}, {b, false, 2}, {EstimationError{0, 0}, true, 3}}, c};
  };
  const std::vector<TrialResult> trials{
      trial(EstimationError{0.03, 0.001}, true, std::nullopt, EstimationError{0.01, 0.002}),
      trial(EstimationError{0.04, 0.1}, true, std::nullopt, std::nullopt),
      trial(EstimationError{5, 0}, false, std::nullopt, EstimationError{0.01, 0.004})};
  const auto rows = summarize(methods, trials);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].method, "a");
  EXPECT_EQ(rows[0].answered, 3);
  EXPECT_EQ(rows[0].successes, 1);
  EXPECT_EQ(rows[0].any_successes, 2);
  EXPECT_NEAR(rows[0].distance.rms, std::sqrt((0.0009 + 0.0016 + 25) / 3), 1e-12);
  EXPECT_EQ(rows[0].distance.median, 0.04);
  EXPECT_EQ(rows[0].seconds[1], 1);
  EXPECT_EQ(rows[1].answered, 0);
  EXPECT_EQ(rows[2].method, bound_name);
  EXPECT_EQ(rows[2].successes, 3);
  EXPECT_EQ(rows[3].method, cramer_rao_name);
  EXPECT_EQ(rows[3].answered, 2);
  EXPECT_EQ(rows[3].distance.rms, 0.01);
  EXPECT_NEAR(rows[3].angle.rms, std::sqrt(10) * 0.001, 1e-12);
}

TEST(Study, AnyOfSeveralAnswersMayBeTheSuccess) {
  const StudyCell cell = studyCells({Figure::accuracy}).front();
  Random random(1, uint64_t(cell.number) << 32);
  const PlanarPose truth = simulateProblem(cell.world, random).map_from_robot;
  const PlanarPose wrong{truth.x + 1, truth.y, truth.phi};
  const TrialResult result =
      runTrial(cell, {fixedAnswer("second", {wrong, truth}), fixedAnswer("none", {wrong})}, 1, 0);
  EXPECT_FALSE(result.outcomes[0].error->isSuccess());
  EXPECT_NEAR(result.outcomes[0].error->distance, 1, 1e-9);
  EXPECT_TRUE(result.outcomes[0].any_success);
  EXPECT_FALSE(result.outcomes[1].any_success);
}

}  // namespace
}  // namespace vmcl

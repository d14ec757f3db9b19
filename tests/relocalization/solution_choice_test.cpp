// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/solution_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic_room.h"

namespace vmcl {
namespace {

class SolutionChoiceTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { map_ = std::make_shared<const KeyframeMap>(mapOf(SyntheticRoom())); }
  static void TearDownTestSuite() { map_.reset(); }

  static std::ptrdiff_t count(const KeyframeMap& map, Solver solution) {
    return std::ranges::count(map.keyframes, solution, &Keyframe::solution);
  }

  inline static std::shared_ptr<const KeyframeMap> map_;
};

TEST_F(SolutionChoiceTest, TheOftenerSeenTheMoreForTwoDepths) {
  const auto oddsOfTwoDepths = [](int observations) {
    KeyframeMap map = *map_;
    for (Landmark& landmark : map.landmarks) landmark.observation_count = observations;
    const SolutionAnalysis analysis = analyzeSolutions(map, map.keyframes[0], {});
    return analysis.two_depth.chance() / analysis.one_point_one_depth.chance();
  };
  EXPECT_NEAR(oddsOfTwoDepths(20), 2 * oddsOfTwoDepths(2), 1e-4);  // gamma of 1 and of a half
  EXPECT_GT(oddsOfTwoDepths(20), 0.8);
}

TEST_F(SolutionChoiceTest, DepthThatIsOftenWrongAsksForOne) {
  KeyframeMap map = *map_;
  for (Landmark& landmark : map.landmarks) landmark.observation_count = 2;  // right half of the time
  chooseByAnalysis(map, {});
  EXPECT_EQ(count(map, Solver::one_point_one_depth), std::ssize(map.keyframes));
}

TEST_F(SolutionChoiceTest, AMeasuredDepthIsAsGoodAsAnotherView) {
  const auto chance = [](int observations) {
    KeyframeMap map = *map_;
    for (Landmark& landmark : map.landmarks) landmark.observation_count = observations;
    return analyzeSolutions(map, map.keyframes[0], {}).two_depth.chance();
  };
  EXPECT_GT(chance(1), 0);
  EXPECT_EQ(chance(1), chance(2));
}

TEST_F(SolutionChoiceTest, SaysNothingWithoutReliableLandmarks) {
  KeyframeMap map = *map_;
  for (Landmark& landmark : map.landmarks) landmark.covariance = 1e4 * Eigen::Matrix3d::Identity();
  std::ranges::fill(map.keyframes[0].landmark_of_feature, -1);
  chooseByAnalysis(map, {});
  EXPECT_EQ(count(map, Solver::automatic), std::ssize(map.keyframes));
}

TEST_F(SolutionChoiceTest, MatchesVote) {
  KeyframeMap map = *map_;
  RelocalizationResult matched;
  matched.keyframes = {3, 5};
  matched.problem.matches.resize(5);
  for (std::size_t i = 3; i < 5; ++i) matched.problem.matches[i].reference_camera = 1;
  EXPECT_EQ(chosenSolution(map, matched), Solver::automatic);
  map.keyframes[3].solution = Solver::two_depth;
  map.keyframes[5].solution = Solver::one_point_one_depth;
  EXPECT_EQ(chosenSolution(map, matched), Solver::two_depth);
  matched.problem.matches.pop_back();
  matched.problem.matches[2].reference_camera = 1;
  EXPECT_EQ(chosenSolution(map, matched), Solver::automatic);
  EXPECT_EQ(chosenSolution(map, {}), Solver::automatic);
}

TEST_F(SolutionChoiceTest, TheMapsChoiceIsDrawn) {
  for (const Solver solution : {Solver::one_point_one_depth, Solver::two_depth}) {
    auto map = std::make_shared<KeyframeMap>(*map_);
    for (Keyframe& keyframe : map->keyframes) keyframe.solution = solution;
    const Image image = SyntheticRoom().look({0.15, -0.25, 0.12}, SyntheticRoom::mount());
    const QueryImage query{image.view(), SyntheticRoom::calibration(), SyntheticRoom::mount(), 0};
    const auto result = Relocalizer(map, {.solution_of_map = true}).relocalize({{query}});
    ASSERT_TRUE(result.estimate.found());
    EXPECT_EQ(result.estimate.modes.front().solver, solution);
  }
}

}  // namespace
}  // namespace vmcl

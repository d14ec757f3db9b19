// SPDX-License-Identifier: BSD-3-Clause
#include "minimal_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "random_scene.h"

namespace vmcl {
namespace {

TEST(EvenOrder, GivesEachNumberOnce) {
  Random random(91);
  std::vector<uint64_t> bounds{5000, 65536, 99991};
  for (uint64_t bound = 1; bound <= 200; ++bound) bounds.push_back(bound);
  for (const uint64_t bound : bounds) {
    EvenOrder order(bound, random);
    std::vector<int> times(bound);
    for (uint64_t i = 0; i < bound; ++i) {
      const uint64_t number = order.next();
      ASSERT_LT(number, bound);
      ++times[number];
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(bound)) << bound;
  }
}

TEST(EvenOrder, StaysBelowTheLargestBound) {
  Random random(92);
  EvenOrder order(uint64_t{1} << 53, random);
  for (int i = 0; i < 10'000; ++i) EXPECT_LT(order.next(), uint64_t{1} << 53);
}

// Any number in a row of the order is as good as any other: the first hundred leave no wide gap.
TEST(EvenOrder, SpreadsFromTheFirstOn) {
  Random random(93);
  for (const uint64_t bound : {1000ULL, 232'767ULL, 99'991ULL}) {
    EvenOrder order(bound, random);
    std::vector<uint64_t> numbers(100);
    for (uint64_t& number : numbers) number = order.next();
    std::sort(numbers.begin(), numbers.end());
    for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_LT(numbers[i] - numbers[i - 1], bound / 20);
  }
}

/// Poses of all samples of a kind, as sorted (x, y).
std::vector<std::pair<double, double>> allPoses(const PoseProblem& problem, Solver kind, uint64_t seed) {
  MinimalSampler sampler(problem, 0.3, seed);
  std::vector<PlanarTransform> poses;
  sampler.draw(kind, static_cast<int>(sampler.sampleCount(kind)), poses);
  std::vector<std::pair<double, double>> places;
  for (const PlanarTransform& pose : poses) places.emplace_back(pose.x, pose.y);
  std::sort(places.begin(), places.end());
  return places;
}

// Whatever the order, all samples together are the same: none is left out, none comes twice.
TEST(MinimalSampler, DrawsEachSampleOnce) {
  Random random(94);
  for (const int matches : {3, 4, 9, 30}) {
    const Scene scene = randomScene(random, {.cameras = 2, .matches = matches, .depth_rate = 0.6, .noise_px = 1});
    for (const Solver kind :
         {Solver::one_point_one_depth, Solver::two_depth, Solver::three_rays, Solver::three_bearings}) {
      if (!MinimalSampler(scene.problem, 0.3, 0).canDraw(kind)) continue;
      const auto poses = allPoses(scene.problem, kind, 1);
      const auto in_other_order = allPoses(scene.problem, kind, 2);
      ASSERT_EQ(poses.size(), in_other_order.size());
      EXPECT_FALSE(poses.empty());
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const double tolerance = 1e-6 * (1 + std::abs(poses[i].first) + std::abs(poses[i].second));
        EXPECT_NEAR(poses[i].first, in_other_order[i].first, tolerance);
      }
    }
  }
}

// The matches of one camera come in a row, as a map gives them: the first samples are of all of them.
TEST(MinimalSampler, FirstSamplesAreOfAllMatches) {
  Random random(95);
  Scene scene = randomScene(random, {.matches = 1000, .depth_rate = 0.233});
  for (std::size_t i = 0; i < 500; ++i) scene.problem.matches[i].query_pixel.x() += 300;  // wrong
  MinimalSampler sampler(scene.problem, 0.3, 1);
  std::vector<PlanarTransform> poses;
  sampler.draw(Solver::one_point_one_depth, 128, poses);
  const auto right = std::count_if(poses.begin(), poses.end(), [&](const PlanarTransform& pose) {
    return difference(pose.pose(), scene.map_from_robot).norm() < 1e-6;
  });
  EXPECT_GT(right, 10);  // 32 expected: fewer would be a false alarm in 100,000
}

/// Sets odds of all matches by whether they are inliers; returns the inliers.
std::vector<int> setOdds(Scene& scene, double of_inliers, double of_outliers) {
  std::vector<int> inliers;
  for (std::size_t i = 0; i < scene.inlier.size(); ++i) {
    scene.problem.matches[i].inlier_odds = scene.inlier[i] ? of_inliers : of_outliers;
    if (scene.inlier[i]) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

// As often as the sampler claims, which its stopping rule rests on: extreme odds and all kinds.
TEST(MinimalSampler, DrawsLikelyInliersMoreOften) {
  Random random(96);
  for (const double odds : {3.0, 30.0, 1000.0}) {
    Scene scene = randomScene(random, {.cameras = 2, .matches = 200, .outlier_rate = 0.9, .depth_rate = 0.6});
    const std::vector<int> inliers = setOdds(scene, odds, 1 / odds);
    for (const Solver kind : {Solver::two_depth, Solver::three_bearings, Solver::one_point_one_depth}) {
      MinimalSampler sampler(scene.problem, 0.2, 1);
      constexpr int samples = 3000;
      int right = 0;
      for (int i = 0; i < samples; ++i) {
        std::vector<PlanarTransform> poses;
        sampler.draw(kind, 1, poses);
        right += std::ranges::any_of(poses, [&](const PlanarTransform& pose) {
          return difference(pose.pose(), scene.map_from_robot).norm() < 1e-4;
        });
      }
      const double chance = sampler.chanceOfInliers(kind, inliers);
      EXPECT_GT(chance, odds == 3 ? 0.04 : 0.6);
      // The claim allows a match twice: 3 % more or less. Beside it 4.5 standard deviations, 1 in 100,000.
      EXPECT_NEAR(right, samples * chance, 4.5 * std::sqrt(samples * chance * (1 - chance)) + 0.03 * samples)
          << "odds " << odds << ", kind " << nameOf(kind);
    }
  }
}

TEST(MinimalSampler, TriesAllOfFewWhateverTheirOdds) {
  Random random(97);
  Scene scene = randomScene(random, {.matches = 6, .depth_rate = 1});
  setOdds(scene, 1, 1);
  const auto all = allPoses(scene.problem, Solver::two_depth, 1);
  scene.problem.matches[0].inlier_odds = 1e-3;
  EXPECT_EQ(allPoses(scene.problem, Solver::two_depth, 1).size(), all.size());
}

}  // namespace
}  // namespace vmcl

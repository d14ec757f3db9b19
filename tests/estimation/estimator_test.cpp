// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/estimator.h"

#include <gtest/gtest.h>

#include "random_scene.h"

namespace vmcl {
namespace {

bool near(const PlanarPose& pose, const PlanarPose& truth) {
  const Eigen::Vector3d d = difference(pose, truth);
  return d.head<2>().norm() < 0.1 && std::abs(d.z()) < 0.02;
}

// Half the matches are outliers; all of 1500 such problems of other seeds are solved by each solver, and at least 91 %
// of what is taken for inliers is. Fewer than 85 of 100 solved: a false alarm in 10^15.
class EachSolver : public testing::TestWithParam<Solver> {};
TEST_P(EachSolver, FindsThePoseAmongOutliers) {
  Random random(51);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Scene scene =
        randomScene(random, {.cameras = 1 + trial % 3, .matches = 60, .outlier_rate = 0.5, .noise_px = 1});
    EstimatorOptions options;
    options.solver = GetParam();
    const PoseEstimate estimate = estimatePose(scene.problem, options);
    if (!estimate.found() || !near(estimate.modes[0].robot_in_map, scene.map_from_robot)) continue;
    ++found;
    int right = 0;
    for (int match : estimate.modes[0].inliers) right += scene.inlier[std::size_t(match)];
    EXPECT_GT(right, 0.85 * double(estimate.modes[0].inliers.size()));
  }
  EXPECT_GE(found, 85);
}
INSTANTIATE_TEST_SUITE_P(Solvers, EachSolver,
                         testing::Values(Solver::automatic, Solver::one_point_one_depth, Solver::two_depth,
                                         Solver::three_bearings),
                         [](const auto& test) { return "solver_" + std::string(nameOf(test.param)); });

TEST(Estimator, SameSeedSameAnswer) {
  Random random(52);
  const Scene scene = randomScene(random, {.outlier_rate = 0.6, .noise_px = 2});
  const PoseEstimate a = estimatePose(scene.problem, {}), b = estimatePose(scene.problem, {});
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t i = 0; i < a.modes.size(); ++i) {
    EXPECT_EQ(a.modes[i].robot_in_map.x, b.modes[i].robot_in_map.x);
    EXPECT_EQ(a.modes[i].log_weight, b.modes[i].log_weight);
    EXPECT_EQ(a.modes[i].covariance, b.modes[i].covariance);
  }
}

TEST(Estimator, SaysWhyThereIsNoPose) {
  Random random(53);
  EXPECT_EQ(estimatePose({}, {}).failure, NoPose::too_few_matches);
  const Scene no_depth = randomScene(random, {.depth_rate = 0});
  const PoseEstimate none = estimatePose(no_depth.problem, {});
  EXPECT_FALSE(none.found());
  EXPECT_EQ(none.failure, NoPose::no_sample);
  EXPECT_FALSE(none.reason.empty());
  Scene identical = randomScene(random, {.depth_rate = 1});
  for (Match& match : identical.problem.matches) match = identical.problem.matches[0];
  const PoseEstimate same = estimatePose(identical.problem, {});
  EXPECT_FALSE(same.found());
  EXPECT_NE(same.failure, NoPose::none);
}

// Sixty matches by chance alone, yet a pose is named for 0.6 % of such problems (18 of 3,000, another seed) where the
// place is likely to be seen, and for none of these where it is not. More than 8, or 3, of 200: a false alarm in
// 10,000.
TEST(Estimator, PureOutliersSeldomGiveAPose) {
  Random random(54);
  EstimatorOptions unlikely_place;
  unlikely_place.in_sight_log_odds = -3;
  int found = 0, found_unlikely = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Scene scene = randomScene(random, {.matches = 60, .outlier_rate = 1});
    found += estimatePose(scene.problem, {}).found();
    found_unlikely += estimatePose(scene.problem, unlikely_place).found();
  }
  EXPECT_LE(found, 8);
  EXPECT_LE(found_unlikely, 3);
}

// Three rays of two references fix the pose without any depth. All of 600 such problems were solved on other seeds,
// more than 99.3 % by that; fewer than 36 of 40: a false alarm in 100,000 at most.
TEST(Estimator, NeedsNoDepthWithTwoReferences) {
  Random random(55);
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Scene scene =
        randomScene(random, {.cameras = 2, .matches = 60, .outlier_rate = 0.3, .depth_rate = 0, .noise_px = 0.5});
    const PoseEstimate estimate = estimatePose(scene.problem, {});
    if (!estimate.found() || !near(estimate.modes[0].robot_in_map, scene.map_from_robot)) continue;
    ++found;
    EXPECT_EQ(estimate.modes[0].solver, Solver::three_rays);
  }
  EXPECT_GE(found, 36);
}

// The pose is found in 99.6 % of 1000 such scenes of other seeds; fewer than 17 of 20: a false
// alarm in 20,000 at most.
TEST(Estimator, FewSamplesAreSharedByTheKinds) {
  Random random(77);
  EstimatorOptions options;
  options.iterations = 100;
  int found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = randomScene(random, {.matches = 50, .depth_rate = 1});
    for (std::size_t i = 2; i < scene.problem.matches.size(); ++i) scene.problem.matches[i].point.reset();
    scene.problem.matches[1].point->point_in_map.x() += 3;  // the one pair with depth is wrong
    const PoseEstimate estimate = estimatePose(scene.problem, options);
    found += estimate.found() && estimate.modes[0].solver == Solver::one_point_one_depth &&
             difference(estimate.modes[0].robot_in_map, scene.map_from_robot).norm() < 0.05;
  }
  EXPECT_GE(found, 17);
}

// At 97 % outliers odds of 3 to 1 tell what else is out of reach: 230 of 300 problems of other seeds are solved,
// without them 148; 40 that say nothing for it are a false alarm in 5,000. Wrong odds do no harm where there are
// inliers enough: all of the 300 are solved.
TEST(Estimator, HeedsOddsButNotBlindly) {
  Random random(79);
  constexpr int trials = 40;
  int found_without = 0, found_with = 0;
  const auto finds = [&](const Scene& scene) {
    const PoseEstimate estimate = estimatePose(scene.problem, {});
    return estimate.found() && difference(estimate.modes[0].robot_in_map, scene.map_from_robot).norm() < 0.1;
  };
  const auto setOdds = [](Scene& scene, double of_inliers) {
    for (std::size_t i = 0; i < scene.inlier.size(); ++i)
      scene.problem.matches[i].inlier_odds = scene.inlier[i] ? of_inliers : 1 / of_inliers;
  };
  for (int trial = 0; trial < trials; ++trial) {
    Scene hard = randomScene(random, {.matches = 200, .outlier_rate = 0.97, .noise_px = 1});
    found_without += finds(hard);
    setOdds(hard, 3);
    found_with += finds(hard);
    Scene easy = randomScene(random, {.matches = 100, .outlier_rate = 0.3, .noise_px = 1});
    setOdds(easy, 1 / 3.0);
    EXPECT_TRUE(finds(easy)) << trial;
  }
  EXPECT_GT(found_with, found_without);
}

// Over 400 other seeds an estimate is off by -0.024 and 0.009 in the mean, with a standard deviation of 0.022: the mean
// of ten would have to stray by ten of its own deviations.
TEST(Estimator, EstimatesTheShareOfInliers) {
  Random random(58);
  for (const double outlier_rate : {0.2, 0.8}) {
    double sum = 0;
    const int trials = 10;
    for (int trial = 0; trial < trials; ++trial) {
      const Scene scene = randomScene(random, {.matches = 300, .outlier_rate = outlier_rate, .noise_px = 1});
      sum += estimatePose(scene.problem, {}).inlier_rate;
    }
    EXPECT_NEAR(sum / trials, 1 - outlier_rate, 0.1);
  }
}

// Told 2 px. Over 400 other seeds the logarithm of the estimate over the truth is 0.08 and -0.01 in the mean, with a
// standard deviation of 0.04 and 0.06: the mean of ten would have to stray by six of its own deviations.
TEST(Estimator, EstimatesThePixelNoise) {
  Random random(60);
  EstimatorOptions options;
  options.estimate_sigma_px = true;
  for (const double noise_px : {0.7, 5.0}) {
    double sum = 0;
    const int trials = 10;
    for (int trial = 0; trial < trials; ++trial) {
      const Scene scene = randomScene(random, {.matches = 150, .outlier_rate = 0.3, .noise_px = noise_px});
      sum += std::log(estimatePose(scene.problem, options).sigma_px / noise_px);
      EXPECT_EQ(estimatePose(scene.problem, {}).sigma_px, 2);
    }
    EXPECT_NEAR(sum / trials, 0, 0.17);
  }
}

// Whatever is broken, the answer is finite, says why there is none, or is refused with a reason.
TEST(Estimator, BearsAnyBrokenInput) {
  Random random(59);
  const double bad[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e300, 1e-300};
  for (int trial = 0; trial < 600; ++trial) {
    Scene scene = randomScene(random, {.cameras = 2, .matches = 2 + trial % 20, .outlier_rate = 0.5, .noise_px = 1});
    EstimatorOptions options;
    options.iterations = 200;
    options.motion = std::array{Motion::planar, Motion::upright, Motion::free}[random.below(3)];
    const double value = bad[random.below(7)];
    Match& match = scene.problem.matches[random.below(uint32_t(scene.problem.matches.size()))];
    QueryCamera& query = scene.problem.query_cameras[0];
    switch (random.below(8)) {
      case 0:
        match.query_pixel.x() = value;
        break;
      case 1:
        match.reference_pixel.y() = value;
        break;
      case 2:
        query.robot_from_camera.matrix()(1, 2) = value;
        break;
      case 3:
        query.camera.fx = value;
        break;
      case 4:
        options.likelihood.sigma_px = value;
        break;
      case 5:
        for (Match& m : scene.problem.matches) m = match;
        break;
      case 6:
        match.query_camera = int(random.below(5)) - 2;
        break;
      default:
        match.point = MapPoint{{value, 1, 1}, value * Eigen::Matrix3d::Identity()};
    }
    try {
      const PoseEstimate estimate = estimatePose(scene.problem, options);
      EXPECT_EQ(estimate.found(), estimate.failure == NoPose::none);
      EXPECT_EQ(estimate.found(), estimate.reason.empty());
      for (const PoseMode& mode : estimate.modes) {
        EXPECT_TRUE(isFinite(mode.robot_in_map));
        EXPECT_TRUE(mode.covariance.allFinite());
        EXPECT_TRUE(std::isfinite(mode.log_weight));
      }
    } catch (const std::invalid_argument& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
}

TEST(Estimator, RefusesBadOptions) {
  const auto withOption = [](auto change) {
    EstimatorOptions options;
    change(options);
    return options;
  };
  EXPECT_THROW(estimatePose({}, withOption([](auto& o) { o.iterations = 0; })), std::invalid_argument);
  EXPECT_THROW(estimatePose({}, withOption([](auto& o) { o.refined = -1; })), std::invalid_argument);
  EXPECT_THROW(estimatePose({}, withOption([](auto& o) { o.max_modes = 0; })), std::invalid_argument);
  EXPECT_THROW(estimatePose({}, {.motion = Motion::free, .solver = Solver::two_depth}), std::invalid_argument);
  EXPECT_THROW(estimatePose({}, withOption([](auto& o) { o.solver = Solver::three_depth; })), std::invalid_argument);
  EXPECT_THROW(estimatePose({}, withOption([](auto& o) { o.likelihood.sigma_px = -1; })), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "random_scene.h"

namespace vmcl {
namespace {

TEST(PoseLikelihood, TruthBeatsOtherPoses) {
  Random random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 2, .outlier_rate = 0.3, .noise_px = 1});
    const PoseLikelihood likelihood(scene.problem, {});
    const double at_truth = likelihood(scene.map_from_robot);
    EXPECT_GT(at_truth, 0);
    for (int k = 0; k < 20; ++k) EXPECT_GT(at_truth, likelihood(randomPose(random, 4)));
  }
}

// The value for one match with depth, by hand.
TEST(PoseLikelihood, MatchWithDepthIsTheFormula) {
  PoseProblem problem;
  Rigid3 mount = Rigid3::Identity();
  mount.linear() = opticalAxes();
  problem.query_cameras.push_back({test_camera, mount});
  problem.reference_cameras.push_back({test_camera, mount});
  // At the origin the point (4, 0, 0) is at the principal point; its uncertainty along y is 0.05 m = 10 px.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(1, 1) = 0.05 * 0.05;
  problem.matches.push_back({0, {643, 481}, 0, {640, 480}, MapPoint{{4, 0, 0}, covariance}});
  const LikelihoodOptions options{.sigma_px = 2, .inlier_prior = 0.25, .level_outliers = false};
  const double su2 = 4 + 100, sv2 = 4;
  const double p = std::exp(-0.5 * (9 / su2 + 1 / sv2)) / (2 * M_PI * std::sqrt(su2 * sv2));
  EXPECT_NEAR(PoseLikelihood(problem, options)(PlanarPose{}), std::log(0.75 + 0.25 * p * 1280 * 960), 1e-9);
  problem.matches[0].inlier_odds = 6;  // over those of 0.25: a chance of 2 / 3
  EXPECT_NEAR(PoseLikelihood(problem, options)(PlanarPose{}), std::log((1 + 2 * p * 1280 * 960) / 3), 1e-9);
  EXPECT_NEAR(PoseLikelihood(problem, options)(PlanarPose{0, 0, M_PI}), -std::log(3), 1e-12);
  problem.matches[0].inlier_odds = 1;
  // Behind the camera only the outlier is left.
  EXPECT_NEAR(PoseLikelihood(problem, options)(PlanarPose{0, 0, M_PI}), std::log(0.75), 1e-12);
}

// Integrated over the query image, the density of a match without depth must be that of a probability: at most one, and
// nearly one when the image holds the whole segment.
TEST(PoseLikelihood, MatchWithoutDepthIsADensityOverTheImage) {
  PoseProblem problem;
  Rigid3 mount = Rigid3::Identity();
  mount.linear() = opticalAxes();
  problem.query_cameras.push_back({test_camera, mount});
  problem.reference_cameras.push_back({test_camera, mount});
  problem.matches.push_back({0, {0, 0}, 0, {640, 480}, {}});
  const LikelihoodOptions options{.sigma_px = 4, .inlier_prior = 0.5, .level_outliers = false};
  const PlanarPose beside{0, 0.3, 0};
  double sum = 0;
  const int step = 2;
  for (int u = 0; u < test_camera.width; u += step)
    for (int v = 430; v < 530; v += step) {
      problem.matches[0].query_pixel = {u, v};
      const double ratio = (std::exp(PoseLikelihood(problem, options)(beside)) - 0.5) / 0.5;
      sum += ratio * step * step / (1280.0 * 960.0);
    }
  EXPECT_LT(sum, 1.1);
  EXPECT_GT(sum, 0.7);
}

TEST(PoseLikelihood, FiniteAndBoundedForAnyPose) {
  Random random(32);
  const Scene scene = randomScene(random, {.outlier_rate = 0.5, .noise_px = 2});
  const PoseLikelihood likelihood(scene.problem, {});
  const double nothing = likelihood.matchCount() * std::log(0.7);
  for (const double reach : {1e-3, 1.0, 1e3, 1e9, 1e150})
    for (int k = 0; k < 100; ++k) {
      const double value = likelihood(randomPose(random, reach));
      EXPECT_TRUE(std::isfinite(value));
      EXPECT_GE(value, nothing - 1e-9);
    }
  // On top of the reference camera there is no baseline.
  const PlanarPose reference = planarPart(scene.problem.reference_cameras[0].map_from_camera *
                                          scene.problem.query_cameras[0].robot_from_camera.inverse());
  EXPECT_TRUE(std::isfinite(likelihood(reference)));
}

TEST(PoseLikelihood, RefusesBadOptionsAndProblems) {
  Random random(34);
  const Scene scene = randomScene(random, {});
  EXPECT_THROW(PoseLikelihood(scene.problem, {.sigma_px = 0}), std::invalid_argument);
  EXPECT_THROW(PoseLikelihood(scene.problem, {.sigma_px = NAN}), std::invalid_argument);
  EXPECT_THROW(PoseLikelihood(scene.problem, {.inlier_prior = 1}), std::invalid_argument);
  PoseProblem broken = scene.problem;
  broken.matches[3].query_pixel.x() = INFINITY;
  EXPECT_THROW(PoseLikelihood(broken, {}), std::invalid_argument);
}

TEST(Likelihood, WithOtherInliersAndNoiseIsAsIfMadeWithThem) {
  Random random(96);
  for (const bool level_outliers : {false, true}) {
    const Scene scene = randomScene(random, {.cameras = 2, .matches = 80, .outlier_rate = 0.5, .noise_px = 2});
    const PoseLikelihood other = PoseLikelihood(scene.problem, {.level_outliers = level_outliers}).with(0.7, 3);
    const PoseLikelihood fresh(scene.problem, {.sigma_px = 3, .inlier_prior = 0.7, .level_outliers = level_outliers});
    const std::vector<PlanarTransform> poses{PlanarTransform(scene.map_from_robot), {1, 0, 2, 3}};
    std::vector<double> other_values(poses.size()), fresh_values(poses.size());
    other.evaluate(poses, other_values);
    fresh.evaluate(poses, fresh_values);
    EXPECT_EQ(other_values, fresh_values);
    EXPECT_EQ(other(poses[0]), fresh(poses[0]));
    EXPECT_THROW(fresh.with(1, 2), std::invalid_argument);
    EXPECT_THROW(fresh.with(0.5, 0), std::invalid_argument);
  }
}

}  // namespace
}  // namespace vmcl

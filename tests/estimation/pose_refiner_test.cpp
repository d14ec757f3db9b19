// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "random_scene.h"
#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

RefinedPose moved(RefinedPose pose, int parameter, double step) {
  double* values[] = {
      &pose.map_from_robot.x, &pose.map_from_robot.y, &pose.map_from_robot.phi, &pose.roll, &pose.pitch, &pose.height};
  *values[parameter] += step;
  return pose;
}

// With exact points the residual's spread does not vary with the pose, and the gradient is exact.
TEST(PoseRefiner, GradientAgreesWithNumericDerivative) {
  Random random(41);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 2, .outlier_rate = 0.2, .depth_rate = 1, .noise_px = 2});
    const PoseLikelihood likelihood(scene.problem, {});
    const PoseRefiner refiner(likelihood, {0.01, 0.01});
    RefinedPose pose;
    pose.map_from_robot = scene.map_from_robot;
    pose.roll = 0.002;
    pose.pitch = -0.003;
    pose.height = 0.004;
    const PoseRefiner::Vector6 gradient = refiner.linearize(pose).gradient;
    for (int k = 0; k < 6; ++k) {
      const double h = 1e-6;
      const double numeric = (likelihood(moved(pose, k, h).rigid()) - likelihood(moved(pose, k, -h).rigid())) / (2 * h);
      EXPECT_NEAR(gradient[k], numeric, 1e-3 * (gradient.cwiseAbs().maxCoeff() + 1)) << "parameter " << k;
    }
  }
}

TEST(PoseRefiner, FindsTheTruthFromNearby) {
  Random random(42);
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 1 + trial % 2, .outlier_rate = 0.2});
    const PoseLikelihood likelihood(scene.problem, {});
    PlanarPose start = scene.map_from_robot;
    start.x += 0.03;
    start.y -= 0.02;
    start.phi += 0.01;
    const RefinedPose refined = PoseRefiner(likelihood, {}).refine(PlanarTransform(start));
    EXPECT_TRUE(refined.constrained);
    // The prior of the depths pulls by a small part of the standard deviation, about 0.01 m here.
    EXPECT_LT(difference(refined.map_from_robot, scene.map_from_robot).norm(), 0.02);
    EXPECT_EQ(refined.roll, 0);
    EXPECT_EQ(refined.height, 0);
  }
}

// Normalized estimation error squared: mean 3 for an honest covariance. Over 400 trials its standard error is 0.12, so
// the bounds are 5 standard errors away: a false alarm in a million. Seed 43.
TEST(PoseRefiner, CovarianceIsHonest) {
  Random random(43);
  double sum = 0;
  const int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    const Scene scene = randomScene(random, {.depth_rate = 0.7, .noise_px = 2, .point_sigma = 0.02});
    const PoseLikelihood likelihood(scene.problem, {.sigma_px = 2, .inlier_prior = 0.9});
    const RefinedPose refined = PoseRefiner(likelihood, {}).refine(PlanarTransform(scene.map_from_robot));
    const Eigen::Vector3d error = difference(refined.map_from_robot, scene.map_from_robot);
    sum += error.dot(refined.covariance.ldlt().solve(error));
  }
  EXPECT_GT(sum / trials, 2.4);
  EXPECT_LT(sum / trials, 3.6);
}

// Of exp(L) over the peak, on a grid of 0.5 standard deviations.
TEST(PoseRefiner, EvidenceIsTheIntegralOfTheLikelihood) {
  Random random(47);
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = randomScene(random, {.depth_rate = 1, .noise_px = 1});
    const PoseLikelihood likelihood(scene.problem, {.sigma_px = 1, .inlier_prior = 0.9});
    const RefinedPose refined = PoseRefiner(likelihood, {}).refine(PlanarTransform(scene.map_from_robot));
    const Eigen::Matrix3d root = refined.covariance.llt().matrixL();
    const double step = 0.5;
    double sum = 0;
    for (double a = -4; a <= 4; a += step)
      for (double b = -4; b <= 4; b += step)
        for (double c = -4; c <= 4; c += step) {
          const Eigen::Vector3d d = root * Eigen::Vector3d(a, b, c);
          const PlanarPose& p = refined.map_from_robot;
          sum += std::exp(likelihood({p.x + d.x(), p.y + d.y(), p.phi + d.z()}) - refined.log_likelihood);
        }
    const double integral = refined.log_likelihood + std::log(sum * std::pow(step, 3) * root.determinant());
    EXPECT_NEAR(refined.log_evidence, integral, 0.1) << "trial " << trial;
  }
}

// A prior so narrow that it changes nothing must not change the evidence either: it is normalized.
TEST(PoseRefiner, EvidenceCountsThePriorOfTheSoftPlane) {
  Random random(48);
  const Scene scene = randomScene(random, {.noise_px = 2});
  const PoseLikelihood likelihood(scene.problem, {});
  const auto evidence = [&](const SoftPlane& plane) {
    return PoseRefiner(likelihood, plane).refine(PlanarTransform(scene.map_from_robot)).log_evidence;
  };
  EXPECT_NEAR(evidence({1e-6, 1e-6}), evidence({}), 1e-2);
  EXPECT_LT(evidence({0.1, 0.1}), evidence({0.01, 0.01}));  // a robot on the plane: width is paid for
}

// Half a degree of roll and pitch: taken up by the soft plane, not by the pose.
TEST(PoseRefiner, SoftPlaneTakesUpTilt) {
  Random random(44);
  double rigid_error = 0, soft_error = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = randomScene(random, {.matches = 80, .depth_rate = 0.5, .noise_px = 0.5});
    const double tilt = 0.5 * M_PI / 180;
    for (QueryCamera& query : scene.problem.query_cameras)  // the robot thinks that it stands upright
      query.robot_from_camera =
          Eigen::AngleAxisd(tilt, Eigen::Vector3d(1, -1, 0).normalized()).toRotationMatrix() * query.robot_from_camera;
    const PoseLikelihood likelihood(scene.problem, {.sigma_px = 1});
    const auto errorWith = [&](const SoftPlane& plane) {
      const RefinedPose refined = PoseRefiner(likelihood, plane).refine(PlanarTransform(scene.map_from_robot));
      return difference(refined.map_from_robot, scene.map_from_robot).norm();
    };
    rigid_error += errorWith({});
    soft_error += errorWith({.sigma_tilt = 0.01, .sigma_height = 0.01});
  }
  EXPECT_LT(soft_error, 0.6 * rigid_error);
}

TEST(PoseRefiner, UnconstrainedPoseIsReported) {
  Random random(45);
  Scene scene = randomScene(random, {.matches = 1, .depth_rate = 1});
  const PoseLikelihood likelihood(scene.problem, {});
  EXPECT_FALSE(PoseRefiner(likelihood, {}).refine(PlanarTransform(scene.map_from_robot)).constrained);
}

TEST(PoseRefiner, ManySharpMatchesConstrainThePose) {
  Random random(46);
  const Scene scene = randomScene(random, {.matches = 400, .depth_rate = 1, .noise_px = 0.01});
  const PoseLikelihood likelihood(scene.problem, {.sigma_px = 0.01});
  const RefinedPose refined = PoseRefiner(likelihood, {}).refine(PlanarTransform(scene.map_from_robot));
  EXPECT_TRUE(refined.constrained);
  EXPECT_LT(difference(refined.map_from_robot, scene.map_from_robot).norm(), 1e-4);
}

TEST(PoseRefiner, RefusesBadPriors) {
  EXPECT_THROW(SoftPlane({.sigma_tilt = -1}).check(), std::invalid_argument);
  EXPECT_THROW(SoftPlane({.sigma_tilt = 0, .sigma_height = NAN}).check(), std::invalid_argument);
}

// Odds of 0.15 on all matches, half of them right: of such odds a share of 0.87 is a half.
TEST(PoseRefiner, TheInlierRateIsThatOfMatchesOfOddsOne) {
  Random random(98);
  Scene scene = randomScene(random, {.matches = 2000, .outlier_rate = 0.5, .noise_px = 1});
  const auto rateWithOdds = [&](double odds) {
    for (Match& match : scene.problem.matches) match.inlier_odds = odds;
    const PoseLikelihood likelihood(scene.problem, {.sigma_px = 1, .inlier_prior = 0.8});
    const PoseRefiner refiner(likelihood, {});
    const RefinedPose peak = refiner.refine(PlanarTransform(scene.map_from_robot));
    EXPECT_NEAR(refiner.linearize(peak).log_likelihood, likelihood(peak.rigid()), 1e-6);
    return refiner.inlierRate(peak, 0.8);
  };
  // The share drawn is 0.5 within 0.011; four times that, 1 in 10,000.
  EXPECT_NEAR(rateWithOdds(1), 0.5, 0.05);
  EXPECT_NEAR(rateWithOdds(0.15), 0.87, 0.03);
}

TEST(PoseRefiner, APoseIsTheOneMadeOfItsMatrix) {
  RefinedPose pose;
  pose.map_from_robot = {1, -2, 2.5};
  pose.roll = -0.4;
  pose.pitch = 0.7;
  pose.height = 0.3;
  EXPECT_TRUE(RefinedPose::at(pose.rigid()).rigid().isApprox(pose.rigid(), 1e-12));
  EXPECT_NEAR(RefinedPose::at(pose.rigid()).pitch, 0.7, 1e-12);
}

// Also where numbers do not fit single precision.
TEST(PoseRefiner, ClimbsToWhereRefinementEnds) {
  Random random(97);
  for (const double noise_px : {1.0, 1e-3}) {
    const Scene scene = randomScene(random, {.matches = 100, .outlier_rate = 0.3, .noise_px = noise_px});
    const PoseLikelihood likelihood(scene.problem, {.sigma_px = noise_px});
    const PoseRefiner refiner(likelihood, {});
    const PlanarPose& truth = scene.map_from_robot;
    const std::vector<PlanarTransform> starts{
        PlanarTransform(PlanarPose{truth.x + noise_px * 0.02, truth.y, truth.phi}),
        PlanarTransform(PlanarPose{truth.x, truth.y - noise_px * 0.02, truth.phi + noise_px * 0.01})};
    const std::vector<ClimbedPose> climbed = refiner.climb(starts);
    ASSERT_EQ(climbed.size(), 1u);  // they meet
    const RefinedPose refined = refiner.refine(starts.front());
    const Eigen::Vector3d d = difference(climbed.front().map_from_robot.pose(), refined.map_from_robot);
    EXPECT_LT(d.dot(refined.covariance.ldlt().solve(d)), 0.1);
    const ClimbedPose again =
        refiner.climb(std::span(starts).subspan(static_cast<std::size_t>(climbed[0].start), 1))[0];
    EXPECT_EQ(again.map_from_robot.x, climbed.front().map_from_robot.x);
    EXPECT_EQ(again.start, 0);
    EXPECT_TRUE(refiner.climb({}).empty());
  }
}

}  // namespace
}  // namespace vmcl

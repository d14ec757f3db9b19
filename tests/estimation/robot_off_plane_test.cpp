// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "random_scene.h"
#include "vmcl/estimation/estimator.h"

namespace vmcl {
namespace {

// The robot believes to stand upright.
Scene tiltedScene(Random& random, double tilt) {
  Scene scene = randomScene(random, {.matches = 80, .noise_px = 1});
  const double heading = random.uniform(-3.1, 3.1);
  const Eigen::Vector3d axis(std::cos(heading), std::sin(heading), 0);
  for (QueryCamera& query : scene.problem.query_cameras)
    query.robot_from_camera = Eigen::AngleAxisd(tilt, axis).toRotationMatrix() * query.robot_from_camera;
  return scene;
}

// Nearly all of these are found without the soft plane as well, but 14 mm off in the median, with it 1.5 mm. It was the
// nearer in 97.5 % of 1200 scenes of other seeds; fewer than 42 of 50: a false alarm in 200,000.
TEST(RobotOffItsPlane, SoftPlaneBearsHalfADegreeOfTilt) {
  Random random(56);
  EstimatorOptions soft;
  soft.plane = {.sigma_tilt = 0.01, .sigma_height = 0.01};
  int nearer = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = tiltedScene(random, 0.5 * M_PI / 180);
    const auto error = [&](const EstimatorOptions& options) {
      const PoseEstimate estimate = estimatePose(scene.problem, options);
      return estimate.found() ? difference(estimate.modes[0].robot_in_map, scene.map_from_robot).head<2>().norm() : 1;
    };
    nearer += error(soft) < std::min(error({}), 0.1);
  }
  EXPECT_GE(nearer, 42);
}

// Told of 99 % of 5000 tilted robots of other seeds, and of none of 1000 upright ones. Fewer than 55 of 60: a false
// alarm in 20,000.
TEST(RobotOffItsPlane, SaysWhenTheRobotIsOffItsPlane) {
  Random random(57);
  int upright = 0, tilted = 0;
  for (int trial = 0; trial < 60; ++trial) {
    upright += estimatePose(tiltedScene(random, 0).problem, {}).off_plane_log_odds < 5;
    tilted += estimatePose(tiltedScene(random, 1 * M_PI / 180).problem, {}).off_plane_log_odds > 5;
  }
  EXPECT_GE(upright, 55);
  EXPECT_GE(tilted, 55);
}

// Lifted by half a metre, and tilted by 20 degrees besides: found by the motion that allows it, though half the matches
// are wrong. Not left to chance but by the noise of some 35 inliers: of the 40 covariances one is off that far in
// 17,000.
TEST(RobotOffItsPlane, IsFoundLiftedOrTilted) {
  Random random(80);
  for (int trial = 0; trial < 20; ++trial) {
    const int cameras = 1 + trial % 2;
    const Scene scene = randomScene(
        random, {.cameras = cameras, .matches = 100, .outlier_rate = 0.5, .depth_rate = 0.7, .noise_px = 1});
    for (const Motion motion : {Motion::upright, Motion::free}) {
      RefinedPose truth;
      truth.map_from_robot = scene.map_from_robot;
      truth.height = 0.5;
      if (motion == Motion::free) truth.roll = truth.pitch = 20 * M_PI / 180;
      const Rigid3 moved = truth.rigid() * toRigid3(scene.map_from_robot).inverse();
      PoseProblem problem = scene.problem;
      for (ReferenceCamera& reference : problem.reference_cameras)
        reference.map_from_camera = moved * reference.map_from_camera;
      for (Match& match : problem.matches)
        if (match.point) match.point->point_in_map = moved * match.point->point_in_map;
      const PoseEstimate estimate = estimatePose(problem, {.motion = motion});
      EXPECT_EQ(estimate.off_plane_log_odds, 0);
      EXPECT_EQ(estimatePose(problem, {.motion = motion}).modes.size(), estimate.modes.size()) << "same seed";
      ASSERT_TRUE(estimate.found()) << trial;
      const PoseMode& mode = estimate.modes.front();
      const Eigen::Vector3d error = difference(mode.robot_in_map, truth.map_from_robot);
      EXPECT_LT(error.head<2>().norm(), 0.1) << trial;
      EXPECT_LT(std::abs(error.z()), 0.03) << trial;
      EXPECT_LT(error.dot(mode.covariance.ldlt().solve(error)), 30) << trial;
      EXPECT_NEAR(mode.height, truth.height, 0.1) << trial;
      EXPECT_NEAR(mode.roll, truth.roll, 0.03) << trial;
      EXPECT_NEAR(mode.pitch, truth.pitch, 0.03) << trial;
      for (Match& match : problem.matches) match.point.reset();
      EXPECT_EQ(estimatePose(problem, {.motion = motion}).failure, NoPose::no_sample);
    }
  }
}

}  // namespace
}  // namespace vmcl

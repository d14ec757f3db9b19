// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "random_scene.h"
#include "vmcl/estimation/likelihood.h"

namespace vmcl {
namespace {

PoseProblem levelCameras() {
  Rigid3 mount = Rigid3::Identity();
  mount.linear() = opticalAxes();
  PoseProblem problem;
  problem.query_cameras.push_back({test_camera, mount});
  problem.reference_cameras.push_back({test_camera, mount});
  return problem;
}

/// What a match that fits a pose exactly adds to L, among outliers of some kind.
double worthOfAMatch(const PoseProblem& outliers, const Eigen::Vector3d& point_in_map) {
  PoseProblem problem = outliers;
  const Eigen::Vector2d pixel = test_camera.project(opticalAxes().transpose() * point_in_map);
  problem.matches.push_back({0, pixel, 0, pixel, MapPoint{point_in_map, Eigen::Matrix3d::Zero()}});
  const PoseLikelihood likelihood(problem, {});
  return likelihood(PlanarPose{}) - likelihood(PlanarPose{0, 0, M_PI});
}

TEST(OutlierDensity, LevelOutliersLessenTheWorthOfAMatchNearTheHorizon) {
  Random random(61);
  PoseProblem level = levelCameras(), uniform = levelCameras();
  for (int i = 0; i < 200; ++i) {
    const double v = random.uniform(-400, 400), farther = random.uniform(0.5, 1);
    const Eigen::Vector2d reference(random.uniform(0, 1280), 480 + v);
    level.matches.push_back({0, {random.uniform(0, 1280), 480 + farther * v}, 0, reference, {}});
    uniform.matches.push_back({0, {random.uniform(0, 1280), random.uniform(0, 960)}, 0, reference, {}});
  }
  const Eigen::Vector3d near_horizon(5, 0, 0.1), far_above(5, 0, 2.5);
  EXPECT_LT(worthOfAMatch(level, near_horizon), worthOfAMatch(level, far_above) - 1);
  EXPECT_LT(worthOfAMatch(level, near_horizon), worthOfAMatch(uniform, near_horizon) - 1);
  EXPECT_NEAR(worthOfAMatch(uniform, near_horizon), worthOfAMatch(uniform, far_above), 1.5);
}

TEST(OutlierDensity, IsFiniteAtTheZenith) {
  Rigid3 to_ceiling = Rigid3::Identity();
  PoseProblem problem;
  problem.query_cameras.push_back({test_camera, to_ceiling});
  problem.reference_cameras.push_back({test_camera, to_ceiling});
  const Eigen::Vector2d zenith(test_camera.cx, test_camera.cy), beside(test_camera.cx + 1, test_camera.cy);
  for (const Eigen::Vector2d& pixel : {zenith, beside}) problem.matches.push_back({0, pixel, 0, {100, 200}, {}});
  problem.matches.push_back({0, {300, 400}, 0, zenith, {}});
  const PoseLikelihood likelihood(problem, {});
  const std::vector<PlanarTransform> poses{PlanarTransform(PlanarPose{0.1, 0.2, 0.3})};
  std::vector<double> many(1);
  likelihood.evaluate(poses, many);
  EXPECT_TRUE(std::isfinite(many[0]));
  EXPECT_NEAR(many[0], likelihood(poses[0]), 1e-4);
}

}  // namespace
}  // namespace vmcl

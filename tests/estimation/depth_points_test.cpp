// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/depth_points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_scene.h"
#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

std::vector<RayToPoint> depthMatches(const Scene& scene) {
  std::vector<RayToPoint> matches;
  for (const Match& match : scene.problem.matches)
    matches.push_back({raysOf(scene.problem, match).ray_in_robot, match.point->point_in_map});
  return matches;
}

TEST(DepthPoints, NoiselessTruthForTwoAndForMany) {
  Random random(21);
  for (int trial = 0; trial < 1000; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 1 + trial % 3, .matches = 2 + trial % 7, .depth_rate = 1});
    const auto pose = solveDepthPoints(depthMatches(scene));
    ASSERT_TRUE(pose);
    EXPECT_LT(difference(pose->pose(), scene.map_from_robot).norm(), 1e-6) << "trial " << trial;
    EXPECT_NEAR(std::hypot(pose->c, pose->s), 1, 1e-12);
  }
}

// Heights near the camera's make the range from height alone useless; bearings still fix the pose when there are three.
TEST(DepthPoints, PointsNearTheHorizonDoLittleHarm) {
  Random random(22);
  std::vector<double> errors;
  for (int trial = 0; trial < 300; ++trial) {
    const PlanarPose truth = randomPose(random);
    std::vector<RayToPoint> matches;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d origin(0, 0, 0.5);
      const double heading = random.uniform(-0.7, 0.7), range = random.uniform(1, 6);
      const Eigen::Vector3d point(range * std::cos(heading), range * std::sin(heading),
                                  0.5 + random.uniform(-0.05, 0.05));
      const double noise = 2.0 / 800;
      Eigen::Vector3d direction = (point - origin).normalized();
      direction += noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      matches.push_back({{origin, direction}, toRigid3(truth) * point});
    }
    if (const auto pose = solveDepthPoints(matches)) errors.push_back(difference(pose->pose(), truth).head<2>().norm());
  }
  ASSERT_GT(errors.size(), 290u);
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.06);
}

TEST(DepthPoints, DegenerateSamplesHaveNoPose) {
  const RayToPoint one{{{0, 0, 0.5}, {1, 0.2, 0.2}}, {3, 0, 1}};
  EXPECT_FALSE(solveDepthPoints({}));
  EXPECT_FALSE(solveDepthPoints(std::vector{one}));
  EXPECT_FALSE(solveDepthPoints(std::vector{one, one}));
  RayToPoint broken = one;
  broken.point_in_map.y() = NAN;
  EXPECT_FALSE(solveDepthPoints(std::vector{one, broken}));
}

}  // namespace
}  // namespace vmcl

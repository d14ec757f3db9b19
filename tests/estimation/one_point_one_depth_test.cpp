// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/one_point_one_depth.h"

#include <gtest/gtest.h>

#include "random_scene.h"
#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

double distanceToNearestRoot(const PlanarRoots& roots, const PlanarPose& truth) {
  double nearest = INFINITY;
  for (int i = 0; i < roots.count; ++i)
    nearest = std::min(nearest, difference(roots.roots[std::size_t(i)].pose(), truth).norm());
  return nearest;
}

// Any mount, any reference, any camera of a rig: the truth is among the roots.
TEST(OnePointOneDepth, NoiselessTruthIsAmongTheRoots) {
  Random random(11);
  int well_conditioned = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 3, .matches = 6, .depth_rate = 1});
    const Match& deep = scene.problem.matches[0];
    const Match& other = scene.problem.matches[std::size_t(1 + trial % 5)];
    const RayToPoint depth{raysOf(scene.problem, deep).ray_in_robot, deep.point->point_in_map};
    if (std::abs(depth.ray_in_robot.direction.normalized().z()) < 0.02) continue;
    const PlanarRoots roots = solveOnePointOneDepth(depth, raysOf(scene.problem, other));
    ASSERT_GE(roots.count, 1);
    const double gap = roots.count == 2 ? difference(roots.roots[0].pose(), roots.roots[1].pose()).norm() : 0;
    if (gap < 0.05) continue;  // near the double root the roots move with the square root of rounding
    ++well_conditioned;
    EXPECT_LT(distanceToNearestRoot(roots, scene.map_from_robot), 1e-7);
  }
  EXPECT_GT(well_conditioned, 1500);
}

TEST(OnePointOneDepth, RootsSatisfyBothMatches) {
  Random random(12);
  for (int trial = 0; trial < 500; ++trial) {
    const Scene scene = randomScene(random, {.matches = 2, .depth_rate = 1});
    const Match& deep = scene.problem.matches[0];
    const RayToPoint depth{raysOf(scene.problem, deep).ray_in_robot, deep.point->point_in_map};
    const RayToRay rays = raysOf(scene.problem, scene.problem.matches[1]);
    const PlanarRoots roots = solveOnePointOneDepth(depth, rays);
    for (int i = 0; i < roots.count; ++i) {
      const Rigid3 map_from_robot = toRigid3(roots.roots[std::size_t(i)].pose());
      const Eigen::Vector3d to_point = depth.point_in_map - map_from_robot * depth.ray_in_robot.origin;
      const Eigen::Vector3d ray = map_from_robot.linear() * depth.ray_in_robot.direction;
      EXPECT_NEAR(to_point.normalized().dot(ray.normalized()), 1, 1e-9);
      const Eigen::Vector3d f = map_from_robot.linear() * rays.ray_in_robot.direction;
      const Eigen::Vector3d b = map_from_robot * rays.ray_in_robot.origin - rays.ray_in_map.origin;
      EXPECT_NEAR(f.normalized().dot(b.cross(rays.ray_in_map.direction.normalized())), 0, 1e-9);
    }
  }
}

// A frontal wall: with the discriminant pushed below zero the double root stays, a unit rotation.
TEST(OnePointOneDepth, NegativeDiscriminantGivesOneUnitRotation) {
  Random random(13);
  int single = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Scene scene = randomScene(random, {.matches = 2, .depth_rate = 1, .noise_px = 20});
    const Match& deep = scene.problem.matches[0];
    const PlanarRoots roots =
        solveOnePointOneDepth({raysOf(scene.problem, deep).ray_in_robot, deep.point->point_in_map},
                              raysOf(scene.problem, scene.problem.matches[1]));
    for (int i = 0; i < roots.count; ++i)
      EXPECT_NEAR(std::hypot(roots.roots[std::size_t(i)].c, roots.roots[std::size_t(i)].s), 1, 1e-9);
    single += roots.count == 1;
  }
  EXPECT_GT(single, 10);
}

TEST(OnePointOneDepth, DegenerateSamplesHaveNoRoot) {
  const RayToPoint depth{{{0, 0, 0.5}, {1, 0, 0.2}}, {3, 0, 1}};
  const RayToRay other{{{0, 0, 0.5}, {1, 0.3, 0.1}}, {{1, 1, 0.4}, {1, 0.1, 0.2}}};
  EXPECT_GT(solveOnePointOneDepth(depth, other).count, 0);
  RayToPoint at_camera_height = depth;
  at_camera_height.point_in_map.z() = 0.5;
  EXPECT_EQ(solveOnePointOneDepth(at_camera_height, other).count, 0);
  RayToPoint behind = depth;
  behind.point_in_map.z() = 0.2;
  EXPECT_EQ(solveOnePointOneDepth(behind, other).count, 0);
  RayToPoint horizontal = depth;
  horizontal.ray_in_robot.direction.z() = 0;
  EXPECT_EQ(solveOnePointOneDepth(horizontal, other).count, 0);
  RayToPoint not_finite = depth;
  not_finite.point_in_map.x() = NAN;
  EXPECT_EQ(solveOnePointOneDepth(not_finite, other).count, 0);
}

}  // namespace
}  // namespace vmcl

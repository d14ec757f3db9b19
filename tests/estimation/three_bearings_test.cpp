// SPDX-License-Identifier: BSD-3-Clause
#include "three_bearings.h"

#include <gtest/gtest.h>

#include "random_scene.h"
#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

// Any cameras of a rig, and heights of the points that are all wrong: only bearings count, and those only with the
// points where they stand for vertical lines.
TEST(ThreeBearings, NoiselessTruthIsAmongTheRoots) {
  Random random(121);
  int well_conditioned = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 3, .matches = 3, .depth_rate = 1});
    std::array<RayToPoint, 3> matches;
    for (std::size_t i = 0; i < 3; ++i) {
      const Match& match = scene.problem.matches[i];
      matches[i] = {raysOf(scene.problem, match).ray_in_robot, match.point->point_in_map};
      matches[i].point_in_map.z() += random.uniform(-1, 1);
      matches[i].ray_in_robot.direction.z() += random.uniform(-1, 1);
    }
    const PlanarRoots roots = solveThreeBearings(matches);
    ASSERT_GE(roots.count, 1) << trial;
    double nearest = INFINITY;
    for (int i = 0; i < roots.count; ++i)
      nearest = std::min(nearest, difference(roots.roots[std::size_t(i)].pose(), scene.map_from_robot).norm());
    if (roots.count == 2 && difference(roots.roots[0].pose(), roots.roots[1].pose()).norm() < 0.05) continue;
    ++well_conditioned;
    EXPECT_LT(nearest, 1e-6) << trial;
  }
  EXPECT_GT(well_conditioned, 900);
}

TEST(ThreeBearings, DegenerateSamplesHaveNoPose) {
  const auto at = [](double x, double y) -> RayToPoint { return {{{0, 0, 1}, {x, y, 0}}, {x, y, 1}}; };
  EXPECT_EQ(solveThreeBearings({at(3, 0), at(3, 0), at(3, 0)}).count, 0);
  EXPECT_EQ(solveThreeBearings({at(1, 1), at(2, 0), at(1, -1)}).count, 0) << "on a circle with the robot";
}

}  // namespace
}  // namespace vmcl

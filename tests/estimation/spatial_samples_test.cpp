// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_scene.h"
#include "three_points.h"
#include "upright_points.h"

namespace vmcl {
namespace {

/// The scene's first matches, their points moved as if the robot were lifted and turned by map_from_map.
std::array<RayToPoint, 3> movedMatches(const Scene& scene, const Rigid3& map_from_map) {
  std::array<RayToPoint, 3> matches;
  for (std::size_t i = 0; i < 3; ++i) {
    const Match& match = scene.problem.matches[i];
    matches[i] = {raysOf(scene.problem, match).ray_in_robot, map_from_map * match.point->point_in_map};
  }
  return matches;
}

bool holds(const std::vector<Rigid3>& poses, const Rigid3& truth) {
  return std::ranges::any_of(poses, [&](const Rigid3& pose) { return (pose.matrix() - truth.matrix()).norm() < 1e-5; });
}

bool explains(const Rigid3& pose, const RayToPoint& match) {
  const Eigen::Vector3d seen = pose.inverse() * match.point_in_map - match.ray_in_robot.origin;
  return seen.normalized().isApprox(match.ray_in_robot.direction.normalized(), 1e-5);
}

TEST(ThreePoints, NoiselessTruthIsAmongThePoses) {
  Random random(111);
  for (int trial = 0; trial < 1000; ++trial) {
    const Scene scene = randomScene(random, {.matches = 3, .depth_rate = 1});
    const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    Rigid3 moved(Eigen::AngleAxisd(random.uniform(-3, 3), axis.normalized()));
    moved.translation().z() = random.uniform(-1, 1);
    const std::array<RayToPoint, 3> matches = movedMatches(scene, moved);
    const std::vector<Rigid3> poses = solveThreePoints(matches);
    EXPECT_TRUE(holds(poses, moved * toRigid3(scene.map_from_robot))) << trial;
    EXPECT_LE(poses.size(), 4u);
    for (const Rigid3& pose : poses)
      for (const RayToPoint& match : matches) EXPECT_TRUE(explains(pose, match)) << trial;
  }
}

TEST(UprightPoints, NoiselessTruthIsAmongThePoses) {
  Random random(112);
  for (int trial = 0; trial < 1000; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 1 + trial % 2, .matches = 3, .depth_rate = 1});
    Rigid3 lifted = Rigid3::Identity();
    lifted.translation().z() = random.uniform(-1, 1);
    const std::array<RayToPoint, 3> matches = movedMatches(scene, lifted);
    const std::vector<Rigid3> poses = solveUprightPoints(matches[0], matches[1]);
    EXPECT_TRUE(holds(poses, lifted * toRigid3(scene.map_from_robot))) << trial;
    for (const Rigid3& pose : poses)
      for (int i = 0; i < 2; ++i) EXPECT_TRUE(explains(pose, matches[static_cast<std::size_t>(i)])) << trial;
  }
}

TEST(SpatialSamples, DegenerateOnesHaveNoPose) {
  const auto at = [](double x, double y, double z) -> RayToPoint { return {{{0, 0, 1}, {x, y, z - 1}}, {x, y, z}}; };
  EXPECT_TRUE(solveUprightPoints(at(3, 0, 1), at(3, 1, 1)).empty()) << "level with the camera: any distance";
  EXPECT_TRUE(solveUprightPoints(at(3, 0, 2), at(3, 0, 2)).empty()) << "one point";
  EXPECT_TRUE(solveThreePoints({at(3, 0, 2), at(3, 0, 2), at(3, 1, 2)}).empty()) << "two points";
  EXPECT_TRUE(solveUprightPoints(at(3, 0, 2), at(3, 0, 0)).empty()) << "one above the other: any heading";
  EXPECT_TRUE(solveThreePoints({at(3, 0, 2), at(3, 1, 2), at(3, 2, 2)}).empty()) << "on a line";
  Random random(113);
  for (int trial = 0; trial < 100; ++trial) {
    std::array<RayToPoint, 3> matches;
    for (RayToPoint& match : matches) {
      const double along = random.uniform(-1, 1);
      match = at(3 + along, 0.5 * along, 2 - along);
    }
    EXPECT_TRUE(solveThreePoints(matches).empty()) << trial;
  }
}

// A square seen head-on, where the cubic loses its leading term.
TEST(ThreePoints, SymmetricViews) {
  for (const double distance : {1.0, 2.0, 5.0}) {
    std::array<RayToPoint, 3> matches;
    const Eigen::Vector3d corners[] = {{distance, 1, 1}, {distance, -1, 1}, {distance, -1, -1}};
    for (std::size_t i = 0; i < 3; ++i) matches[i] = {{Eigen::Vector3d::Zero(), corners[i]}, corners[i]};
    EXPECT_TRUE(holds(solveThreePoints(matches), Rigid3::Identity())) << distance;
    std::swap(matches[0], matches[1]);
    EXPECT_TRUE(holds(solveThreePoints(matches), Rigid3::Identity())) << distance;
  }
}

}  // namespace
}  // namespace vmcl

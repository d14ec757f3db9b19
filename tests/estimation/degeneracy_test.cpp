// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/degeneracy.h"

#include <gtest/gtest.h>

#include <numeric>

#include "random_scene.h"

namespace vmcl {
namespace {

/// A level camera at the origin of the map and one at `query`, which see the points; every other has depth.
std::vector<Degeneracy> seen(const PlanarPose& query, const std::vector<Eigen::Vector3d>& points) {
  Rigid3 mount = Rigid3::Identity();
  mount.linear() = opticalAxes();
  PoseProblem problem;
  problem.query_cameras.push_back({test_camera, mount});
  problem.reference_cameras.push_back({test_camera, mount});
  const Rigid3 camera_from_map = (toRigid3(query) * mount).inverse();
  for (const Eigen::Vector3d& point : points) {
    Match match{0, test_camera.project(camera_from_map * point), 0, test_camera.project(mount.inverse() * point), {}};
    if (problem.matches.size() % 2 == 0) match.point = MapPoint{point, Eigen::Matrix3d::Zero()};
    problem.matches.push_back(match);
  }
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return degeneracies(problem, all, query, 1);
}

std::vector<Eigen::Vector3d> box(Random& random, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i)
    points.emplace_back(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()),
                        random.uniform(low.z(), high.z()));
  return points;
}

TEST(Degeneracy, NoneInARoom) {
  Random random(71);
  EXPECT_TRUE(seen({0.5, 0.8, 0.1}, box(random, {4, -2, -1.5}, {8, 2, 1.5})).empty());
}

TEST(Degeneracy, NoBaselineWhereTheReferenceStood) {
  Random random(72);
  const auto found = seen({0.001, 0, 0.1}, box(random, {4, -2, -1.5}, {8, 2, 1.5}));
  EXPECT_EQ(std::count(found.begin(), found.end(), Degeneracy::no_baseline), 1);
}

TEST(Degeneracy, PointsAtTheHeightOfTheCamera) {
  Random random(73);
  EXPECT_EQ(seen({0.5, 0.8, 0.1}, box(random, {4, -2, -0.005}, {8, 2, 0.005})), std::vector{Degeneracy::horizon});
}

TEST(Degeneracy, WallAheadOnTheWayToIt) {
  Random random(74);
  EXPECT_EQ(seen({1, 0, 0}, box(random, {6, -2, -1.5}, {6, 2, 1.5})), std::vector{Degeneracy::wall});
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/people.h"

#include <gtest/gtest.h>

#include "simulation/drive.h"

namespace vmcl {
namespace {

using Eigen::Vector3d;

struct Extent {
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  Vector3d middle() const { return (low + high) / 2; }
};

Extent extentOf(const std::vector<Face>& faces) {
  Extent extent;
  for (const Face& face : faces)
    for (const Vector3d& corner : face.corners) {
      extent.low = extent.low.cwiseMin(corner);
      extent.high = extent.high.cwiseMax(corner);
    }
  return extent;
}

Trajectory standing(const Eigen::Vector2d& place) {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 200; ++i) poses.push_back({100 + 0.1 * i, toRigid3(PlanarPose{place.x(), place.y(), 0})});
  return Trajectory(poses);
}

TEST(Crowd, isAsTallAsToldAndStandsOnTheGround) {
  for (const double height : {1.5, 1.9}) {
    Person person{.path = {{2, 3}}};
    person.height = height;
    const Extent extent = extentOf(Crowd({person}, standing({9, 9})).at(105));
    EXPECT_NEAR(extent.high.z(), height, 0.03);
    EXPECT_NEAR(extent.low.z(), 0, 0.05);
    EXPECT_NEAR((extent.middle().head<2>() - Eigen::Vector2d(2, 3)).norm(), 0, 0.15);
  }
}

TEST(Crowd, walksToAndFro) {
  const Person person{.path = {{0, 0}, {4, 0}}, .speed = 1};
  const Crowd crowd({person}, standing({9, 9}));
  EXPECT_NEAR(extentOf(crowd.at(102)).middle().x(), 2, 0.2);
  EXPECT_NEAR(extentOf(crowd.at(104)).middle().x(), 4, 0.2);
  EXPECT_NEAR(extentOf(crowd.at(107)).middle().x(), 1, 0.2);
}

TEST(Crowd, waitsForTheRobotAndStepsAside) {
  const Person walker{.path = {{0, 0}, {4, 0}}, .speed = 1};
  const Extent waiting = extentOf(Crowd({walker}, standing({2, 0})).at(110));
  EXPECT_NEAR(waiting.middle().x(), 1.1, 0.2);
  const Person stander{.path = {{0.1, 0}}};
  EXPECT_NEAR(extentOf(Crowd({stander}, standing({0, 0})).at(110)).middle().x(), 0.6, 0.15);
}

TEST(Crowd, sitsAtTheHeightOfAChair) {
  Person person{.path = {{0, 0}}};
  person.sits = true;
  const Extent extent = extentOf(Crowd({person}, standing({9, 9})).at(100));
  EXPECT_LT(extent.high.z(), 1.45);
  EXPECT_GT(extent.high.z(), 1.2);
  EXPECT_GT(extent.high.x(), 0.35);  // knees
}

}  // namespace
}  // namespace vmcl

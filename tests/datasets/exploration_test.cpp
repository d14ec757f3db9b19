// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/exploration.h"

#include <gtest/gtest.h>

#include "simulation/shapes.h"

namespace vmcl {
namespace {

/// A closed house of 6 m x 4 m with a wall in the middle that leaves a gap of a metre.
Scene house() {
  Scene scene;
  const auto wall = [&](double x, double y, double half_x, double half_y) {
    addBox(scene, scene.addObject("wall"), {{x, y, 0}, {half_x, half_y}, 0, 2}, {"plain", {}}, {});
  };
  wall(3, -0.1, 3.2, 0.1);
  wall(3, 4.1, 3.2, 0.1);
  wall(-0.1, 2, 0.1, 2);
  wall(6.1, 2, 0.1, 2);
  wall(3, 1.5, 0.1, 1.5);
  return scene;
}

TEST(Explore, drivesThroughBothRoomsAndTouchesNothing) {
  const FloorPlan plan(trianglesOf(house()), 0.5);
  for (const uint64_t seed : {1u, 2u, 3u}) {
    Random random(seed);
    const Trajectory path = explore({}, plan, {}, 5, 120, random);
    EXPECT_NEAR(path.poses().back().time, 125, 0.02);
    EXPECT_FALSE(obstacleOf(path, {}, plan));
    int west = 0;
    for (const StampedPose& pose : path.poses()) {
      const auto place = pose.map_from_robot.translation();
      ASSERT_TRUE(place.x() > 0 && place.x() < 6 && place.y() > 0 && place.y() < 4);
      west += place.x() < 3;
    }
    const auto all = static_cast<int>(path.poses().size());
    EXPECT_TRUE(west > all / 10 && west < all * 9 / 10) << "seed " << seed << ": " << west << " of " << all;
  }
}

TEST(Explore, theSameSeedGivesTheSameWay) {
  const FloorPlan plan(trianglesOf(house()), 0.5);
  Random once(7), twice(7);
  const auto a = explore({}, plan, PlanarPose{1, 1, 0}, 0, 20, once).poses(),
             b = explore({}, plan, PlanarPose{1, 1, 0}, 0, 20, twice).poses();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.back().map_from_robot.matrix() == b.back().map_from_robot.matrix());
  EXPECT_NEAR(a.front().map_from_robot.translation().x(), 1, 1e-12);
}

TEST(Explore, saysWhenThereIsNoRoom) {
  const FloorPlan plan(trianglesOf(house()), 0.5);
  Random random(1);
  EXPECT_THROW(explore({.radius = 2.5}, plan, PlanarPose{1, 1, 0}, 0, 20, random), std::runtime_error);
}

TEST(FloorPlan, measuresClearanceToTheNearestThing) {
  const Scene scene = house();
  const FloorPlan plan(trianglesOf(scene), 0.5);
  EXPECT_NEAR(plan.clearance({1, 2}), 1, 2 * plan.cell());
  EXPECT_NEAR(plan.clearance({2.6, 1}), 0.3, 2 * plan.cell());
  EXPECT_EQ(plan.nearestObject({2.6, 1}), 4u);
}

}  // namespace
}  // namespace vmcl

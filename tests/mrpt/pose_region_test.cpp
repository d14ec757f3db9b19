// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_region.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

/// 4 m x 4 m of unknown space with a free square, x and y in [0, 1).
mrpt::maps::COccupancyGridMap2D gridWithFreeSquare() {
  mrpt::maps::COccupancyGridMap2D grid(-2, 2, -2, 2, 0.1F);
  for (unsigned x = 0; x < grid.getSizeX(); ++x)
    for (unsigned y = 0; y < grid.getSizeY(); ++y) {
      const double at_x = grid.idx2x(x), at_y = grid.idx2y(y);
      if (at_x > 0 && at_x < 1 && at_y > 0 && at_y < 1) grid.setCell(static_cast<int>(x), static_cast<int>(y), 0.9F);
    }
  return grid;
}

TEST(PoseRegion, FillsABox) {
  const PoseBox box{-1, 3, 5, 6, 0, 1};
  const PoseRegion region(box);
  EXPECT_DOUBLE_EQ(region.volume(), 4);
  Random random(1);
  Eigen::Vector3d low(9, 9, 9), high(-9, -9, -9);
  for (int i = 0; i < 1000; ++i) {
    const PlanarPose pose = region.draw(random);
    low = low.cwiseMin(Eigen::Vector3d(pose.x, pose.y, pose.phi));
    high = high.cwiseMax(Eigen::Vector3d(pose.x, pose.y, pose.phi));
  }
  // 1000 draws leave more than 2 % of a side empty with a chance of 2e-9.
  EXPECT_TRUE((low.array() >= Eigen::Array3d(-1, 5, 0)).all() &&
              (low.array() < Eigen::Array3d(-0.9, 5.03, 0.03)).all());
  EXPECT_TRUE((high.array() <= Eigen::Array3d(3, 6, 1)).all() &&
              (high.array() > Eigen::Array3d(2.9, 5.97, 0.97)).all());
}

TEST(PoseRegion, StaysOnFreeCells) {
  const auto grid = gridWithFreeSquare();
  const PoseRegion whole({-2, 2, -2, 2}, grid), part({-2, 0.49, -2, 2}, grid);
  EXPECT_NEAR(whole.volume(), 2 * std::numbers::pi, 1e-4);
  EXPECT_NEAR(part.volume(), std::numbers::pi, 1e-4);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const PlanarPose pose = whole.draw(random);
    EXPECT_TRUE(pose.x > -1e-3 && pose.x < 1.001 && pose.y > -1e-3 && pose.y < 1.001);
  }
}

TEST(PoseRegion, RefusesWhatHoldsNoPose) {
  EXPECT_THROW(PoseRegion(PoseBox{1, 0, 0, 1}), std::invalid_argument);
  EXPECT_THROW(PoseRegion(PoseBox{0, std::nan(""), 0, 1}), std::invalid_argument);
  EXPECT_THROW(PoseRegion({-2, -1, -2, -1}, gridWithFreeSquare()), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

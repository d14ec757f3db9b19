// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/depth_image.h"

#include <gtest/gtest.h>

#include <limits>

namespace vmcl {
namespace {

/// 20x20, 2 m away, on the right of column 11 3 m.
DepthImage step() {
  DepthImage image{20, 20, std::vector<float>(400, 2)};
  for (std::size_t i = 0; i < 400; ++i)
    if (i % 20 > 11) image.depths[i] = 3;
  return image;
}

TEST(DepthImage, KnowsItsDepthAwayFromEdges) {
  EXPECT_EQ(depthAt(step(), {5.4, 7.6}), 2);
  EXPECT_EQ(depthAt(step(), {9.4, 7}), 2);
  EXPECT_EQ(depthAt(step(), {9.6, 7}), 0);
  EXPECT_EQ(depthAt(step(), {13.4, 7}), 0);
  EXPECT_EQ(depthAt(step(), {14, 7}), 3);
}

TEST(DepthImage, NeedsHalfOfItsNeighbours) {
  DepthImage image = step();
  image.depths[7 * 20 + 5] = 0;
  EXPECT_EQ(depthAt(image, {5, 7}), 2);
  for (std::size_t row = 0; row <= 7; ++row)
    for (std::size_t column = 0; column < 20; ++column) image.depths[row * 20 + column] = 0;
  EXPECT_EQ(depthAt(image, {5, 7}), 0);
  EXPECT_EQ(depthAt(image, {5, 10}), 2);
}

TEST(DepthImage, KnowsNothingOutside) {
  for (double far : {-3.0, 25.0, 1e30, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(depthAt(step(), {far, 7}), 0) << far;
    EXPECT_EQ(depthAt(step(), {7, far}), 0) << far;
  }
  EXPECT_EQ(depthAt({}, {0, 0}), 0);
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/dense_view.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

/// A camera that looks at the plane n . X = 1, n in the optical frame.
class DenseViewTest : public ::testing::Test {
 protected:
  DenseViewTest() {
    for (int row = 0; row < DenseView::depthRows(camera_); ++row)
      for (int column = 0; column < DenseView::depthColumns(camera_); ++column)
        view_.depth.push_back(static_cast<uint16_t>(
            std::lround(1e3 * depthOfPlane(DenseView::depth_step * Eigen::Vector2d(column, row)))));
  }

  double depthOfPlane(const Eigen::Vector2d& pixel) const {
    return 1 / Eigen::Vector3d(0.1, 0.2, 0.4).dot(camera_.ray(pixel));
  }

  const PinholeCamera camera_{83, 61, 80, 80, 41, 30};
  DenseView view_;
};

TEST_F(DenseViewTest, InterpolatesAsOnAPlane) {
  for (double v = -0.5; v < 60; v += 3.3)
    for (double u = -0.5; u < 80; u += 3.7) {
      const Eigen::Vector2d pixel(u, v), inside = pixel.cwiseMax(0);
      const auto depth = view_.depthAt(camera_, pixel);
      ASSERT_TRUE(depth) << pixel.transpose();
      EXPECT_NEAR(*depth, depthOfPlane(inside), 2e-3) << pixel.transpose();
    }
}

TEST_F(DenseViewTest, KnowsNothingOutsideOrWithoutDepths) {
  EXPECT_FALSE(view_.depthAt(camera_, {83, 10}));
  EXPECT_FALSE(view_.depthAt(camera_, {10, -1}));
  EXPECT_FALSE(DenseView().depthAt(camera_, {10, 10}));
}

TEST_F(DenseViewTest, KnowsNothingAtHolesAndEdges) {
  const std::size_t place = static_cast<std::size_t>(2 * DenseView::depthColumns(camera_) + 3);
  for (const uint16_t depth : {uint16_t{0}, static_cast<uint16_t>(view_.depth[place] * 1.3)}) {
    view_.depth[place] = depth;
    EXPECT_FALSE(view_.depthAt(camera_, {13, 9}));
    EXPECT_FALSE(view_.depthAt(camera_, {11, 7}));
    EXPECT_TRUE(view_.depthAt(camera_, {17, 9}));
  }
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vmcl {

/// How far what each pixel of an image shows lies along the camera's optical axis (m); 0 where that is not known.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> depths{};  ///< by rows from the top

  bool empty() const { return depths.empty(); }
};

/// Depth at a pixel of the real (distorted) image: the median of the 5x5 pixels about it. 0 where fewer than half of
/// these are known, or they differ by more than a tenth: an edge, where a pixel's error changes the surface seen.
float depthAt(const DepthImage& image, const Eigen::Vector2d& pixel);

}  // namespace vmcl

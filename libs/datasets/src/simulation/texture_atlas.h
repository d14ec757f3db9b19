// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace vmcl {

/// Many images in one, side by side on shelves, each with its border repeated around it so that interpolation at an
/// edge sees no neighbour.
struct TextureAtlas {
  cv::Mat image;
  std::vector<cv::Rect> places;  ///< of each image given; empty for an empty one
};

/// Throws std::runtime_error when an image is wider, or all together are higher, than `max_side_px`.
TextureAtlas packAtlas(const std::vector<cv::Mat>& images, int max_side_px);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "vmcl/vision/image.h"

namespace vmcl {

/// Where an image shows the robot itself, in the part of it below some rows.
class ImageMask {
 public:
  /// `mask`: grey, 128 or more where hidden; empty: nowhere. Throws std::invalid_argument unless it has the image's
  /// size.
  ImageMask(const ImageView& mask, cv::Size image_size, int rows_from_top);

  /// The image with what is hidden replaced by a smooth continuation of its surroundings, in which no detector finds
  /// anything that would take a share of the features.
  cv::Mat filled(const cv::Mat& grey) const;

  /// Whether the keypoint's structure reaches into what is hidden.
  bool touches(const cv::KeyPoint& keypoint) const;

 private:
  cv::Mat hidden_;            ///< 255 where hidden; empty: nowhere
  cv::Mat pixels_to_hidden_;  ///< distance of each pixel
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "vmcl/vision/image_mask.h"

namespace vmcl {

/// What a mask hides of the part of an image below the mask's rows.
class HiddenParts {
 public:
  explicit HiddenParts(const ImageMask& mask);

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

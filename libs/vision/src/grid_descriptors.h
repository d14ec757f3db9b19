// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vmcl/vision/features.h"

namespace vmcl {

/// Points that look like something, and how they look.
struct GridDescriptors {
  std::vector<int> points;  ///< indices of those that are not in blank surroundings
  Descriptors descriptors;  ///< a row each, like SIFT's
};

/// Upright histograms of gradients, 4 x 4 of 8 directions over 48 pixels about each point of a grey image.
GridDescriptors describePoints(const cv::Mat& grey, std::span<const Eigen::Vector2f> points);

}  // namespace vmcl

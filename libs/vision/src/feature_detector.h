// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "vmcl/vision/features.h"

namespace vmcl {

/// Features in the order that the detector found them.
struct DetectedFeatures {
  std::vector<cv::KeyPoint> keypoints;  ///< where they really are, in pixels
  Descriptors descriptors;              ///< as many rows
};

/// A way to find and describe features. Thread safe.
class FeatureDetector {
 public:
  virtual ~FeatureDetector() = default;
  virtual int descriptorBytes() const = 0;
  virtual DetectedFeatures detect(const cv::Mat& grey) const = 0;
};

/// ORB, SIFT or AKAZE, at least `max_features` where the image has so many.
std::unique_ptr<FeatureDetector> classicalDetector(FeatureKind kind, int max_features);

/// The strongest `max_features` of a network. Completes or checks the model's checksum. Throws std::runtime_error
/// naming the file.
std::unique_ptr<FeatureDetector> networkDetector(FeatureModel& model, int max_features);

}  // namespace vmcl

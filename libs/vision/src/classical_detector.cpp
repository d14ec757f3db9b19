// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

#include "feature_detector.h"

namespace vmcl {
namespace {

constexpr float orb_pyramid_scale = 1.2f;
constexpr int orb_fast_threshold = 7;             // OpenCV's 20 and
constexpr double sift_contrast_threshold = 0.02;  // 0.04 and
constexpr float akaze_threshold = 3e-4f;          // 1e-3 leave plain walls empty; max_features is the limit

/// Coordinate along an image side of a keypoint of ORB: OpenCV multiplies the coordinate in the pyramid's level by the
/// scale, but the level's pixels are areas, and its side was rounded.
float unbiasedCoordinate(float coordinate, int octave, int side) {
  const float scale = std::pow(orb_pyramid_scale, static_cast<float>(octave));
  const float true_scale = static_cast<float>(side) / std::round(static_cast<float>(side) / scale);
  return (coordinate / scale + 0.5f) * true_scale - 0.5f;
}

/// RootSIFT (Arandjelovic and Zisserman, CVPR 2012): square roots of the L1-normalized histogram, a unit vector.
void writeRootSift(const float* histogram, uint8_t* descriptor) {
  float sum = 0;
  for (int i = 0; i < 128; ++i) sum += histogram[i];
  const float scale = sum > 0 ? 1 / sum : 0;
  for (int i = 0; i < 128; ++i)
    descriptor[i] = static_cast<uint8_t>(std::min(255.0f, std::round(512 * std::sqrt(histogram[i] * scale))));
}

class ClassicalDetector : public FeatureDetector {
 public:
  ClassicalDetector(FeatureKind kind, int max_features) : kind_(kind), max_features_(max_features) {}

  int descriptorBytes() const override {
    return kind_ == FeatureKind::orb ? 32 : kind_ == FeatureKind::akaze ? 64 : 128;
  }

  DetectedFeatures detect(const cv::Mat& grey) const override {
    DetectedFeatures found;
    cv::Mat descriptors;
    detector()->detectAndCompute(grey, cv::noArray(), found.keypoints, descriptors);
    for (cv::KeyPoint& keypoint : found.keypoints) keypoint.pt = unbiasedPosition(keypoint, grey.size());
    found.descriptors.setZero(descriptors.rows, descriptorBytes());
    for (int row = 0; row < descriptors.rows; ++row) {
      uint8_t* const descriptor = found.descriptors.row(row).data();
      if (kind_ == FeatureKind::sift)
        writeRootSift(descriptors.ptr<float>(row), descriptor);
      else
        std::copy_n(descriptors.ptr<uint8_t>(row), descriptors.cols, descriptor);
    }
    return found;
  }

 private:
  /// One a call, since those of OpenCV are not thread safe; making one costs nothing.
  cv::Ptr<cv::Feature2D> detector() const {
    if (kind_ == FeatureKind::sift) return cv::SIFT::create(max_features_, 3, sift_contrast_threshold);
    if (kind_ == FeatureKind::akaze) return cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, akaze_threshold);
    return cv::ORB::create(max_features_, orb_pyramid_scale, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31,
                           orb_fast_threshold);
  }

  cv::Point2f unbiasedPosition(const cv::KeyPoint& keypoint, cv::Size size) const {
    if (kind_ == FeatureKind::akaze) return keypoint.pt;
    if (kind_ == FeatureKind::sift) return keypoint.pt - cv::Point2f(0.25f, 0.25f);  // from doubling the image
    return {unbiasedCoordinate(keypoint.pt.x, keypoint.octave, size.width),
            unbiasedCoordinate(keypoint.pt.y, keypoint.octave, size.height)};
  }

  FeatureKind kind_;
  int max_features_;
};

}  // namespace

std::unique_ptr<FeatureDetector> classicalDetector(FeatureKind kind, int max_features) {
  return std::make_unique<ClassicalDetector>(kind, max_features);
}

}  // namespace vmcl

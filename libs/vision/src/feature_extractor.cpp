// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

#include "feature_detector.h"
#include "hidden_parts.h"

namespace vmcl {
namespace {

constexpr int min_image_side = 16;  // pixels; less holds no feature and upsets the pyramids of OpenCV

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void checkImage(const ImageView& image, const CameraCalibration& calibration) {
  calibration.check();
  const PinholeCamera& camera = calibration.pinhole;
  if (image.empty() || image.width != camera.width || image.height != camera.height)
    throw std::invalid_argument("image is " + sizeText(image.width, image.height) + " pixels, its camera " +
                                sizeText(camera.width, camera.height));
  if (image.channels != 1 && image.channels != 3)
    throw std::invalid_argument("image has " + std::to_string(image.channels) + " channels, not 1 or 3");
  if (image.row_bytes < static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels))
    throw std::invalid_argument("image rows are " + std::to_string(image.row_bytes) + " bytes, too short");
}

/// The image below the mask in grey. Cut off rather than masked: what shows the robot itself then takes no share of
/// the features and enters no descriptor.
cv::Mat visibleGrey(const ImageView& image, int mask_rows) {
  const cv::Mat all(image.height, image.width, image.channels == 1 ? CV_8UC1 : CV_8UC3,
                    const_cast<uint8_t*>(image.pixels), image.row_bytes);
  const cv::Mat visible = all.rowRange(mask_rows, image.height);
  if (image.channels == 1) return visible;
  cv::Mat grey;
  cv::cvtColor(visible, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

/// Rows of the keypoints, strongest first; ties in an order that is the same in every run.
std::vector<int> strongestFirst(const std::vector<cv::KeyPoint>& keypoints, int max_count) {
  std::vector<int> rows(keypoints.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>(i);
  const auto key = [&](int row) {
    const cv::KeyPoint& k = keypoints[static_cast<std::size_t>(row)];
    return std::tuple(-k.response, k.pt.y, k.pt.x, k.size, k.angle);
  };
  std::sort(rows.begin(), rows.end(), [&](int a, int b) { return key(a) < key(b); });
  rows.resize(std::min(rows.size(), static_cast<std::size_t>(max_count)));
  return rows;
}

}  // namespace

FeatureExtractor::FeatureExtractor(const FeatureOptions& options) : options_(options) {
  options.check();
  detector_ = options.kind == FeatureKind::network ? networkDetector(options_.model, options.max_features)
                                                   : classicalDetector(options.kind, options.max_features);
}

FeatureExtractor::~FeatureExtractor() = default;
FeatureExtractor::FeatureExtractor(FeatureExtractor&&) noexcept = default;
FeatureExtractor& FeatureExtractor::operator=(FeatureExtractor&&) noexcept = default;

const FeatureOptions& FeatureExtractor::options() const { return options_; }

FeatureSet FeatureExtractor::extract(const ImageView& image, const CameraCalibration& calibration) const {
  return extract(image, calibration, {.rows_from_top = options_.mask_rows_from_top});
}

FeatureSet FeatureExtractor::extract(const ImageView& image, const CameraCalibration& calibration,
                                     const ImageMask& mask) const {
  checkImage(image, calibration);
  mask.check(image.width, image.height);
  FeatureSet features;
  features.kind = options_.kind;
  features.descriptors.resize(0, detector_->descriptorBytes());
  const HiddenParts hidden(mask);
  const cv::Mat grey = hidden.filled(visibleGrey(image, mask.rows_from_top));
  if (std::min(grey.cols, grey.rows) < min_image_side) return features;

  const DetectedFeatures found = detector_->detect(grey);
  std::vector<int> kept = strongestFirst(found.keypoints, options_.max_features);
  std::erase_if(kept, [&](int row) { return hidden.touches(found.keypoints[static_cast<std::size_t>(row)]); });
  features.descriptors.resize(static_cast<Eigen::Index>(kept.size()), Eigen::NoChange);
  for (int row : kept) {
    const cv::KeyPoint& keypoint = found.keypoints[static_cast<std::size_t>(row)];
    const Eigen::Vector2d distorted(keypoint.pt.x, keypoint.pt.y + static_cast<float>(mask.rows_from_top));
    const Eigen::Vector2d ideal = calibration.undistort(distorted);
    // Far outside the calibrated field the distortion has no inverse.
    if (!((calibration.distort(ideal) - distorted).norm() < 0.1)) continue;
    features.descriptors.row(features.size()) = found.descriptors.row(row);
    features.pixels.push_back(ideal.cast<float>());
    features.sizes.push_back(keypoint.size);
    features.responses.push_back(keypoint.response);
  }
  features.descriptors.conservativeResize(features.size(), Eigen::NoChange);
  return features;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

#include "image_mask.h"
#include "vmcl/vision/features.h"

namespace vmcl {
namespace {

constexpr int min_image_side = 16;  // pixels; less holds no feature and upsets the pyramids of OpenCV
constexpr float orb_pyramid_scale = 1.2f;
constexpr int orb_fast_threshold = 7;             // OpenCV's 20 and
constexpr double sift_contrast_threshold = 0.02;  // 0.04 leave plain walls empty; max_features is the limit

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void checkImage(const ImageView& image, const CameraCalibration& calibration, const FeatureOptions& options) {
  calibration.check();
  const PinholeCamera& camera = calibration.pinhole;
  if (image.empty() || image.width != camera.width || image.height != camera.height)
    throw std::invalid_argument("image is " + sizeText(image.width, image.height) + " pixels, its camera " +
                                sizeText(camera.width, camera.height));
  if (image.channels != 1 && image.channels != 3)
    throw std::invalid_argument("image has " + std::to_string(image.channels) + " channels, not 1 or 3");
  if (image.row_bytes < static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels))
    throw std::invalid_argument("image rows are " + std::to_string(image.row_bytes) + " bytes, too short");
  if (options.mask_rows_from_top >= image.height)
    throw std::invalid_argument("mask_rows_from_top is " + std::to_string(options.mask_rows_from_top) + " of " +
                                std::to_string(image.height) + " image rows");
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

/// Coordinate along an image side of a keypoint of ORB: OpenCV multiplies the coordinate in the pyramid's level by the
/// scale, but the level's pixels are areas, and its side was rounded.
float unbiasedCoordinate(float coordinate, int octave, int side) {
  const float scale = std::pow(orb_pyramid_scale, static_cast<float>(octave));
  const float true_scale = static_cast<float>(side) / std::round(static_cast<float>(side) / scale);
  return (coordinate / scale + 0.5f) * true_scale - 0.5f;
}

/// Where the keypoint really is, in pixels of the image.
cv::Point2f unbiasedPosition(const cv::KeyPoint& keypoint, FeatureKind kind, cv::Size size) {
  if (kind == FeatureKind::sift) return keypoint.pt - cv::Point2f(0.25f, 0.25f);  // from doubling the image
  return {unbiasedCoordinate(keypoint.pt.x, keypoint.octave, size.width),
          unbiasedCoordinate(keypoint.pt.y, keypoint.octave, size.height)};
}

/// RootSIFT (Arandjelovic and Zisserman, CVPR 2012): square roots of the L1-normalized histogram, a unit vector,
/// stored as bytes of 1/512.
void writeRootSift(const float* histogram, uint8_t* descriptor) {
  float sum = 0;
  for (int i = 0; i < 128; ++i) sum += histogram[i];
  const float scale = sum > 0 ? 1 / sum : 0;
  for (int i = 0; i < 128; ++i)
    descriptor[i] = static_cast<uint8_t>(std::min(255.0f, std::round(512 * std::sqrt(histogram[i] * scale))));
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

struct FeatureExtractor::Detector {
  FeatureOptions options;
  cv::Ptr<cv::Feature2D> feature2d;
};

FeatureExtractor::FeatureExtractor(const FeatureOptions& options) : detector_(std::make_unique<Detector>()) {
  options.check();
  detector_->options = options;
  if (options.kind == FeatureKind::sift)
    detector_->feature2d = cv::SIFT::create(options.max_features, 3, sift_contrast_threshold);
  else
    detector_->feature2d = cv::ORB::create(options.max_features, orb_pyramid_scale, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE,
                                           31, orb_fast_threshold);
}

FeatureExtractor::~FeatureExtractor() = default;
FeatureExtractor::FeatureExtractor(FeatureExtractor&&) noexcept = default;
FeatureExtractor& FeatureExtractor::operator=(FeatureExtractor&&) noexcept = default;

const FeatureOptions& FeatureExtractor::options() const { return detector_->options; }

FeatureSet FeatureExtractor::extract(const ImageView& image, const CameraCalibration& calibration,
                                     const ImageView& mask) const {
  const FeatureOptions& options = detector_->options;
  checkImage(image, calibration, options);
  FeatureSet features;
  features.kind = options.kind;
  features.descriptors.resize(0, descriptorBytes(options.kind));
  const ImageMask hidden(mask, {image.width, image.height}, options.mask_rows_from_top);
  const cv::Mat grey = hidden.filled(visibleGrey(image, options.mask_rows_from_top));
  if (std::min(grey.cols, grey.rows) < min_image_side) return features;

  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  detector_->feature2d->detectAndCompute(grey, cv::noArray(), keypoints, descriptors);
  std::vector<int> kept = strongestFirst(keypoints, options.max_features);
  std::erase_if(kept, [&](int row) { return hidden.touches(keypoints[static_cast<std::size_t>(row)]); });
  features.descriptors.resize(static_cast<Eigen::Index>(kept.size()), descriptorBytes(options.kind));
  for (int row : kept) {
    const cv::KeyPoint& keypoint = keypoints[static_cast<std::size_t>(row)];
    const cv::Point2f position = unbiasedPosition(keypoint, options.kind, grey.size());
    const Eigen::Vector2d distorted(position.x, position.y + static_cast<float>(options.mask_rows_from_top));
    const Eigen::Vector2d ideal = calibration.undistort(distorted);
    // Far outside the calibrated field the distortion has no inverse.
    if (!((calibration.distort(ideal) - distorted).norm() < 0.1)) continue;
    uint8_t* descriptor = features.descriptors.row(features.size()).data();
    if (options.kind == FeatureKind::sift)
      writeRootSift(descriptors.ptr<float>(row), descriptor);
    else
      std::copy_n(descriptors.ptr<uint8_t>(row), descriptorBytes(options.kind), descriptor);
    features.pixels.push_back(ideal.cast<float>());
    features.sizes.push_back(keypoint.size);
    features.responses.push_back(keypoint.response);
  }
  features.descriptors.conservativeResize(features.size(), Eigen::NoChange);
  return features;
}

}  // namespace vmcl

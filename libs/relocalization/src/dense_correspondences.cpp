// SPDX-License-Identifier: BSD-3-Clause
#include "dense_correspondences.h"

#include <optional>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

/// Nothing far outside the calibrated field, where the distortion has no inverse.
std::optional<Eigen::Vector2d> idealPixel(const CameraCalibration& calibration, const Eigen::Vector2f& distorted) {
  const Eigen::Vector2d ideal = calibration.undistort(distorted.cast<double>());
  if (!((calibration.distort(ideal) - distorted.cast<double>()).norm() < 0.1)) return std::nullopt;
  return ideal;
}

}  // namespace

std::vector<DenseCorrespondence> denseCorrespondences(const DenseMatcher& matcher,
                                                      const CameraCalibration& query_calibration,
                                                      const KeyframeMap& map, const Keyframe& reference) {
  const MapCamera& camera = map.cameras[static_cast<std::size_t>(reference.camera)];
  const PinholeCamera& pinhole = camera.calibration.pinhole;
  const Image image = decompressImage(reference.dense.image);
  if (image.width != pinhole.width || image.height != pinhole.height)
    throw std::runtime_error("the map's image at " + std::to_string(reference.time) + " s has another size");
  std::vector<Eigen::Vector2f> points = denseGrid(image.width, image.height, camera.imageMask());
  std::vector<int> landmarks(points.size(), -1);
  for (std::size_t i = 0; i < reference.landmark_of_feature.size(); ++i) {
    if (reference.landmark_of_feature[i] < 0) continue;
    points.push_back(camera.calibration.distort(reference.features.pixels[i].cast<double>()).cast<float>());
    landmarks.push_back(reference.landmark_of_feature[i]);
  }
  std::vector<DenseCorrespondence> correspondences;
  for (const DenseMatch& found : matcher.match(image.view(), points)) {
    const auto point = static_cast<std::size_t>(found.point);
    const auto query_pixel = idealPixel(query_calibration, found.query_pixel);
    const auto reference_pixel = idealPixel(camera.calibration, points[point]);
    if (query_pixel && reference_pixel) correspondences.push_back({*query_pixel, *reference_pixel, landmarks[point]});
  }
  return correspondences;
}

}  // namespace vmcl

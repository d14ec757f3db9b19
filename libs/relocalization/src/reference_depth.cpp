// SPDX-License-Identifier: BSD-3-Clause
#include "reference_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace vmcl {
namespace {

// Standard deviation of a measured depth: twice Kinect's (Khoshelham and Elberink 2012), for what calibration and the
// times of image and depth add.
constexpr double measured_sigma_at_1m = 0.003;
constexpr double measured_sigma_floor = 0.005;

constexpr double interpolation_reach_px = 48;
constexpr double interpolation_largest_step = 1.15;  // ratio of the depths of landmarks on one surface
constexpr double interpolation_sigma = 0.03;         // at least, relative: between landmarks there may be anything

}  // namespace

ReferenceDepth::ReferenceDepth(const KeyframeMap& map, const Keyframe& keyframe, const std::vector<bool>& is_reliable)
    : keyframe_(keyframe),
      camera_(map.cameras[static_cast<std::size_t>(keyframe.camera)]),
      map_from_camera_(map.referenceCamera(keyframe).map_from_camera) {
  if (!keyframe.dense.depth.empty()) return;
  const Rigid3 camera_from_map = map_from_camera_.inverse();
  for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i) {
    const int landmark = keyframe.landmark_of_feature[i];
    if (landmark < 0 || !is_reliable[static_cast<std::size_t>(landmark)]) continue;
    const double depth = (camera_from_map * map.landmarks[static_cast<std::size_t>(landmark)].point_in_map).z();
    if (depth > 0) landmarks_.push_back({keyframe.features.pixels[i].cast<double>(), depth});
  }
}

std::optional<MapPoint> ReferenceDepth::at(const Eigen::Vector2d& ideal_pixel) const {
  const auto known = keyframe_.dense.depth.empty() ? interpolated(ideal_pixel) : measured(ideal_pixel);
  if (!known) return std::nullopt;
  const PinholeCamera& pinhole = camera_.calibration.pinhole;
  const Eigen::Vector3d ray = pinhole.ray(ideal_pixel);
  const double sigma_across = known->depth / pinhole.fx;  // a pixel
  Eigen::Matrix3d covariance = known->sigma * known->sigma * ray * ray.transpose();
  covariance.diagonal().head<2>().array() += sigma_across * sigma_across;
  const Eigen::Matrix3d map_from_camera = map_from_camera_.linear();
  covariance = map_from_camera * covariance * map_from_camera.transpose();
  return MapPoint{map_from_camera_ * (known->depth * ray), (covariance + covariance.transpose()) / 2};
}

auto ReferenceDepth::measured(const Eigen::Vector2d& ideal_pixel) const -> std::optional<DepthWithSigma> {
  const auto depth = keyframe_.dense.depthAt(camera_.calibration.pinhole, camera_.calibration.distort(ideal_pixel));
  if (!depth) return std::nullopt;
  return DepthWithSigma{*depth, measured_sigma_floor + measured_sigma_at_1m * *depth * *depth};
}

/// From the three nearest landmarks.
auto ReferenceDepth::interpolated(const Eigen::Vector2d& ideal_pixel) const -> std::optional<DepthWithSigma> {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<std::pair<double, const KnownDepth*>, 3> nearest;
  nearest.fill({infinity, nullptr});
  for (const KnownDepth& known : landmarks_) {
    const double distance = (known.pixel - ideal_pixel).norm();
    if (!(distance < nearest.back().first)) continue;
    nearest.back() = {distance, &known};
    std::ranges::sort(nearest);
  }
  if (!(nearest.back().first <= interpolation_reach_px)) return std::nullopt;
  double weights = 0, inverse_depth = 0, near = infinity, far = 0;
  for (const auto& [distance, known] : nearest) {
    const double weight = 1 / (1 + distance);
    weights += weight;
    inverse_depth += weight / known->depth;
    near = std::min(near, known->depth);
    far = std::max(far, known->depth);
  }
  if (far > interpolation_largest_step * near) return std::nullopt;
  const double depth = weights / inverse_depth;
  return DepthWithSigma{depth, std::max((far - near) / 2, interpolation_sigma * depth)};
}

}  // namespace vmcl

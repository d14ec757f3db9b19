// SPDX-License-Identifier: BSD-3-Clause
#include "noise_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

constexpr std::size_t fewest_residuals = 100;   // whose median tells a standard deviation to a tenth
constexpr double least_pixel = 0.05;            // what is left by rounding must not
constexpr double least_inverse_depth = 0.0005;  // look exact (1/m)

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// How much smaller a point that is fitted to them makes its squared residuals.
double shareLeft(const Reconstruction& scene, const Track& track) {
  double equations = 2 * static_cast<double>(track.size());
  for (const Observation& seen : track) equations += scene.depth(seen) > 0;
  return (equations - 3) / equations;
}

}  // namespace

MeasurementNoise estimatedNoise(const Reconstruction& scene, const MeasurementNoise& assumed) {
  std::vector<double> squared_pixels, squared_depths;
  for (const ScenePoint& point : scene.points) {
    const double share_left = shareLeft(scene, point.track);
    if (!(share_left > 0)) continue;
    for (const Observation& seen : point.track) {
      const ReferenceCamera view = scene.view(seen.keyframe);
      const Eigen::Vector3d p = view.map_from_camera.inverse() * point.point_in_map;
      if (!(p.z() > 0)) continue;
      squared_pixels.push_back((view.camera.project(p) - scene.idealPixel(seen)).squaredNorm() / share_left);
      if (const double depth = scene.depth(seen); depth > 0)
        squared_depths.push_back(std::pow(1 / p.z() - 1 / depth, 2) / share_left);
    }
  }
  // The median of a chi-square of 2 degrees of freedom is 2 ln 2, that of one 0.4549.
  MeasurementNoise noise = assumed;
  if (squared_pixels.size() >= fewest_residuals)
    noise.pixel = std::max(least_pixel, std::sqrt(medianOf(squared_pixels) / (2 * std::numbers::ln2)));
  if (squared_depths.size() >= fewest_residuals)
    noise.inverse_depth = std::max(least_inverse_depth, std::sqrt(medianOf(squared_depths) / 0.4549));
  return noise;
}

}  // namespace vmcl

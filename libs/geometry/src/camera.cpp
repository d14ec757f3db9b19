// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/camera.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

void require(bool holds, const std::string& what, double value) {
  if (!holds) throw std::invalid_argument("camera " + what + " is " + std::to_string(value));
}

}  // namespace

void PinholeCamera::check() const {
  require(width >= 1 && width <= 65536, "width", width);
  require(height >= 1 && height <= 65536, "height", height);
  require(std::isfinite(fx) && fx > 0, "fx", fx);
  require(std::isfinite(fy) && fy > 0, "fy", fy);
  require(std::isfinite(cx), "cx", cx);
  require(std::isfinite(cy), "cy", cy);
}

void CameraCalibration::check() const {
  pinhole.check();
  for (double k : distortion) require(std::isfinite(k), "distortion", k);
}

namespace {

/// Distorted normalized coordinates of ideal ones.
Eigen::Vector2d distortNormalized(const Eigen::Vector2d& p, const std::array<double, 5>& d) {
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double xy = p.x() * p.y();
  return radial * p + Eigen::Vector2d(2 * d[2] * xy + d[3] * (r2 + 2 * p.x() * p.x()),
                                      d[2] * (r2 + 2 * p.y() * p.y()) + 2 * d[3] * xy);
}

Eigen::Vector2d toPixel(const PinholeCamera& camera, const Eigen::Vector2d& normalized) {
  return camera.project({normalized.x(), normalized.y(), 1});
}

}  // namespace

Eigen::Vector2d CameraCalibration::distort(const Eigen::Vector2d& ideal_pixel) const {
  return toPixel(pinhole, distortNormalized(pinhole.ray(ideal_pixel).head<2>(), distortion));
}

Eigen::Vector2d CameraCalibration::undistort(const Eigen::Vector2d& distorted_pixel) const {
  if (!isDistorted()) return distorted_pixel;
  const Eigen::Vector2d target = pinhole.ray(distorted_pixel).head<2>();
  Eigen::Vector2d ideal = target;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d step = target - distortNormalized(ideal, distortion);
    ideal += step;
    if (step.squaredNorm() < 1e-20) break;
  }
  return toPixel(pinhole, ideal);
}

}  // namespace vmcl

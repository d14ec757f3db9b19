// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "scene_renderer.h"
#include "sensor_setup.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// What a real camera makes of an ideal view: blur, lens distortion, gain and noise, in this order.
class ImageFormation {
 public:
  explicit ImageFormation(const SimulatedCamera& camera);

  /// The ideal camera to draw with: as the real one, or wide enough for the pixels that its lens bends inwards.
  const PinholeCamera& ideal() const { return ideal_; }

  /// BGR; `turn_rate` of the camera about its own axes (rad/s), `gain` of the brightness.
  cv::Mat image(const cv::Mat& ideal_bgr, const Eigen::Vector3d& turn_rate, double gain, Random& random) const;

  /// Millimetres along the optical axis (16 bit), 0 where it is not measured.
  cv::Mat depth(const cv::Mat& ideal_depth, Random& random) const;

 private:
  cv::Mat blurred(const cv::Mat& image, const Eigen::Vector3d& turn_rate) const;

  SimulatedCamera camera_;
  PinholeCamera ideal_;
  cv::Mat map_;  ///< of each pixel of the real image, the place in the ideal one; empty without distortion
};

}  // namespace vmcl

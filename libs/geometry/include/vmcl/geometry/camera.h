// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace vmcl {

/// Ideal pinhole camera. Pixels: u right, v down, (0, 0) the centre of the top left pixel. Optical frame: x right,
/// y down, z forward.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;

  /// Throws std::invalid_argument naming the bad value: sizes in [1, 65536], focal lengths positive, all finite.
  void check() const;

  /// Pixel of a point with positive z.
  Eigen::Vector2d project(const Eigen::Vector3d& point_in_camera) const {
    return {fx * point_in_camera.x() / point_in_camera.z() + cx, fy * point_in_camera.y() / point_in_camera.z() + cy};
  }

  /// Viewing ray of a pixel with z = 1.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const { return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1}; }

  /// K: homogeneous pixels of points.
  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d K;
    K << fx, 0, cx, 0, fy, cy, 0, 0, 1;
    return K;
  }

  /// K^-1: viewing rays with z = 1 of homogeneous pixels.
  Eigen::Matrix3d inverseMatrix() const {
    Eigen::Matrix3d K;
    K << 1 / fx, 0, -cx / fx, 0, 1 / fy, -cy / fy, 0, 0, 1;
    return K;
  }

  bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 && pixel.y() < height - 0.5;
  }
};

/// A real camera: pinhole with the radial and tangential distortion (k1, k2, p1, p2, k3) of Brown 1971, the order of
/// OpenCV and MRPT.
struct CameraCalibration {
  PinholeCamera pinhole;
  std::array<double, 5> distortion{};

  void check() const;
  bool isDistorted() const { return distortion != std::array<double, 5>{}; }

  /// Distorted pixel of an ideal one.
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal_pixel) const;

  /// Ideal pixel of a distorted one (fixed-point iteration, as in OpenCV).
  Eigen::Vector2d undistort(const Eigen::Vector2d& distorted_pixel) const;
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction.h"

namespace vmcl {

/// Of Huber's loss, which every measurement has: standard deviations.
inline constexpr double huber_threshold = 2;

/// Where a robot stands: roll, pitch and phi (rad), then x, y and height (m). Its pose over Reconstruction's
/// level_from_robot.
using Stand = Eigen::Vector<double, 6>;

/// A CameraCorrection: rotation, shift, lens.
using CorrectionVector = Eigen::Vector<double, 9>;

Stand standOf(const Reconstruction& scene, std::size_t keyframe);
CorrectionVector correctionVector(const CameraCorrection& correction);

/// Error of a measurement and its derivatives, in standard deviations.
template <int rows>
struct Linearized {
  Eigen::Vector<double, rows> error;
  Eigen::Matrix<double, rows, 6, Eigen::RowMajor> by_stand;
  Eigen::Matrix<double, rows, 9, Eigen::RowMajor> by_correction;
  Eigen::Matrix<double, rows, 3, Eigen::RowMajor> by_point;
};

/// Whence a measurement was taken, as given.
struct MeasuringCamera {
  const MapCamera* camera;
  const Rigid3* level_from_robot;  ///< as in Reconstruction
};

/// Where a feature was seen.
struct PixelMeasurement {
  static constexpr int rows = 2;

  MeasuringCamera from;
  Eigen::Vector2d pixel;  ///< of the real image
  double sigma_px;

  Linearized<2> linearize(const Stand& stand, const CorrectionVector& correction,
                          const Eigen::Vector3d& point_in_map) const;
};

/// How deep it was measured to lie. Errors are those of the inverse of the depth.
struct DepthMeasurement {
  static constexpr int rows = 1;

  MeasuringCamera from;
  double depth;  ///< along the optical axis (m)
  double sigma;  ///< of its inverse (1/m)

  Linearized<1> linearize(const Stand& stand, const CorrectionVector& correction,
                          const Eigen::Vector3d& point_in_map) const;
};

}  // namespace vmcl

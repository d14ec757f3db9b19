// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement_noise.h"
#include "reconstruction.h"

namespace vmcl {

/// Standard deviations of what the adjustment weighs; below a millionth of a unit counts as a millionth.
struct AdjustmentNoise {
  MeasurementNoise measurement;
  double position = 0.02;        ///< of the given robot poses (m)
  double heading = 0.01;         ///< of the given robot poses (rad)
  double tilt = 0.005;           ///< of the robot's roll and pitch about the given (rad)
  double height = 0.003;         ///< of its height about the given (m)
  double mount_rotation = 0.05;  ///< of the given mounts' roll, pitch and yaw (rad)
  double mount_shift = 0.02;     ///< of the given mounts' x and y (m)
  double focal = 0.03;           ///< of the given focal lengths, relative
  double radial = 0.1;           ///< of the given k1 and k2

  /// 1 / sigma of the planar pose's (x, y, phi).
  Eigen::Vector3d poseWeights() const;
  /// 1 / sigma of Reconstruction::stance.
  Eigen::Vector3d stanceWeights() const;
  /// 1 / sigma of each angle of a mount.
  Eigen::Vector3d mountRotationWeights() const;
  /// 1 / sigma of a mount's (x, y, z).
  Eigen::Vector3d mountShiftWeights() const;
  /// 1 / sigma of CameraCorrection::lens.
  Eigen::Vector3d lensWeights() const;
  /// 1 / sigma of CameraCorrection::radial.
  Eigen::Vector3d radialWeights() const;
};

/// Bundle adjustment: moves points, poses, stances and camera corrections to the least robust sum of squared errors of
/// reprojection and depth and deviations from what was given, each in standard deviations. Deterministic.
/// Throws std::runtime_error when it fails numerically.
void adjust(Reconstruction& scene, const AdjustmentNoise& noise);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement_noise.h"
#include "measurement_residuals.h"

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

  /// 1 / sigma of a Stand.
  Stand standWeights() const;
  /// 1 / sigma of a CorrectionVector.
  CorrectionVector correctionWeights() const;
};

/// Bundle adjustment: moves points, stands and camera corrections to the least robust sum of squared errors of pixels
/// and depths and deviations from what was given, each in standard deviations, until a step makes the sum smaller by
/// less than a share of `tolerance`. Deterministic. Throws std::runtime_error when it fails numerically.
void adjust(Reconstruction& scene, const AdjustmentNoise& noise, double tolerance);

}  // namespace vmcl

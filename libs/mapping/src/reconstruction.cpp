// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction.h"

namespace vmcl {

CameraCalibration withFocalLengthScaled(CameraCalibration calibration, double scale) {
  calibration.pinhole.fx *= scale;
  calibration.pinhole.fy *= scale;
  const double s2 = scale * scale;
  const double factors[] = {s2, s2 * s2, scale, scale, s2 * s2 * s2};  // of k1, k2, p1, p2, k3
  for (std::size_t i = 0; i < 5; ++i) calibration.distortion[i] *= factors[i];
  return calibration;
}

}  // namespace vmcl

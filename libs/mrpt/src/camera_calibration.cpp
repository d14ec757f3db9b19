// SPDX-License-Identifier: BSD-3-Clause
#include "camera_calibration.h"

#include <algorithm>
#include <stdexcept>

namespace vmcl {

CameraCalibration calibrationOf(const mrpt::img::TCamera& camera) {
  using mrpt::img::DistortionModel;
  if (camera.fx() == 0 && camera.fy() == 0) throw std::runtime_error("no intrinsics");
  CameraCalibration calibration;
  calibration.pinhole = {static_cast<int>(camera.ncols),
                         static_cast<int>(camera.nrows),
                         camera.fx(),
                         camera.fy(),
                         camera.cx(),
                         camera.cy()};
  if (camera.distortion != DistortionModel::none) {
    const bool rational = std::any_of(camera.dist.begin() + 5, camera.dist.end(), [](double k) { return k != 0; });
    if (camera.distortion != DistortionModel::plumb_bob || rational)
      throw std::runtime_error("lens model other than k1, k2, p1, p2, k3");
    std::copy_n(camera.dist.begin(), 5, calibration.distortion.begin());
  }
  calibration.check();
  return calibration;
}

}  // namespace vmcl

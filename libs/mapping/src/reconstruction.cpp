// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction.h"

namespace vmcl {

CameraCalibration Reconstruction::calibration(int camera) const {
  const auto i = static_cast<std::size_t>(camera);
  CameraCalibration corrected = cameras[i].calibration;
  const CameraCorrection& correction = corrections[i];
  corrected.pinhole.fx *= 1 + correction.lens[0];
  corrected.pinhole.fy *= 1 + correction.lens[0];
  corrected.distortion[0] += correction.lens[1];
  corrected.distortion[1] += correction.lens[2];
  return corrected;
}

Eigen::Vector2d Reconstruction::distortedPixel(const Observation& observation) const {
  const Keyframe& keyframe = keyframes[static_cast<std::size_t>(observation.keyframe)];
  return cameras[static_cast<std::size_t>(keyframe.camera)].calibration.distort(givenPixel(observation));
}

Eigen::Vector2d Reconstruction::idealPixel(const Observation& observation) const {
  const int camera = keyframes[static_cast<std::size_t>(observation.keyframe)].camera;
  return calibration(camera).undistort(distortedPixel(observation));
}

}  // namespace vmcl

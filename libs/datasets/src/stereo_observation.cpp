// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_observation.h"

namespace vmcl {

mrpt::obs::CObservationStereoImages stereoObservation(const mrpt::obs::CObservationImage& left, double baseline) {
  mrpt::obs::CObservationStereoImages pair;
  pair.sensorLabel = left.sensorLabel;
  pair.timestamp = left.timestamp;
  pair.leftCamera = pair.rightCamera = left.cameraParams;
  pair.cameraPose = mrpt::poses::CPose3DQuat(left.cameraPose);
  pair.rightCameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(baseline, 0, 0, 0, 0, 0));  // optical axes
  pair.hasImageRight = true;
  return pair;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/query_image.h"

namespace vmcl {

QueryImage queryImage(const CameraObservation& observation, const KeyframeMap& map) {
  for (const MapCamera& camera : map.cameras)
    if (camera.label == observation.label)
      return {observation.image.view(), camera.calibration, camera.robot_from_camera, camera.imageMask()};
  return {observation.image.view(), observation.calibration, observation.robot_from_camera};
}

}  // namespace vmcl

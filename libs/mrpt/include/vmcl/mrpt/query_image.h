// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

/// The image as a query to the map; it and the map must outlive the query. A camera with the label of a camera of the
/// map is that camera: mount, calibration and mask are the map's.
QueryImage queryImage(const CameraObservation& observation, const KeyframeMap& map);

}  // namespace vmcl

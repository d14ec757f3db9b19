// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>

#include "vmcl/vision/depth_image.h"

namespace vmcl {

/// What a CObservation3DRangeScan measured, as seen by the camera of cameraObservation(): its range image, moved there
/// if another camera took it. Empty for other classes and without a range image. One kept outside the log lies in
/// `directory`. Throws std::runtime_error naming the sensor label: a range image that cannot be read or has another
/// size than its intrinsics, units or poses that are not finite.
DepthImage measuredDepth(const mrpt::obs::CObservation& observation, const std::filesystem::path& directory);

}  // namespace vmcl

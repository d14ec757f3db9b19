// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>

#include "vmcl/vision/depth_image.h"

namespace vmcl {

/// What was measured beside the image of cameraObservation(), as seen by its camera. Of a CObservation3DRangeScan the
/// range image, moved there if another camera took it; one kept outside the log lies in `directory`. Of a
/// CObservationStereoImages what stereoDepth() makes of its two images. Empty for other classes and without a range or
/// right image. Throws std::runtime_error naming the sensor label: images that cannot be read or have another size than
/// their intrinsics, units or poses that are not finite, cameras that do not stand side by side.
DepthImage measuredDepth(const mrpt::obs::CObservation& observation, const std::filesystem::path& directory);

}  // namespace vmcl

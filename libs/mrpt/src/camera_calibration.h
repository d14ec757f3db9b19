// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>

#include "vmcl/geometry/camera.h"

namespace vmcl {

/// Throws std::runtime_error or std::invalid_argument without intrinsics, and for other lens models than ours.
CameraCalibration calibrationOf(const mrpt::img::TCamera& camera);

}  // namespace vmcl

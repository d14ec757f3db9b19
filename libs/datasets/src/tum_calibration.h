// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <filesystem>

namespace vmcl {

/// calibration.yaml beside a TUM data set.
struct TumCalibration {
  mrpt::img::TCamera camera;
  mrpt::poses::CPose3D robot_from_camera;  ///< optical axes
  int mask_rows_from_top = 0;
};

/// Throws std::runtime_error naming file, line and key.
TumCalibration readTumCalibration(const std::filesystem::path& file);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "vmcl/datasets/import_report.h"

namespace vmcl {

/// Makes a rawlog of a directory of images (.png, .jpg) whose names are their times in seconds, e.g.
/// 1305031102.175.png, with calibration.yaml as for importTum. poses.txt (TUM format, map_from_robot) becomes
/// `<log>.groundtruth.tum`, odometry.txt the odometry, where there are. An image without a time in its name and one
/// that cannot be read are left out and named. Throws std::runtime_error naming file and reason: no calibration, a bad
/// pose, no image.
ImportReport importImages(const std::filesystem::path& directory, const std::filesystem::path& log,
                          const std::function<void(double share)>& progress = {});

}  // namespace vmcl

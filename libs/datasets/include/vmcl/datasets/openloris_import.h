// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "vmcl/datasets/import_report.h"

namespace vmcl {

/// Makes a rawlog, sorted by time, of a sequence of OpenLORIS-Scene (Shi et al. 2020): of its extracted directory
/// (color.txt, aligned_depth.txt, odom.txt, groundtruth.txt, sensors.yaml, trans_matrix.yaml) or of its ROS 1 bag
/// (topics /d400/color/image_raw and camera_info, /d400/aligned_depth_to_color/image_raw, /odom, /scan, /gt,
/// /tf_static). Colour and depth of the D435i become CObservation3DRangeScan, colour alone CObservationImage. The
/// ground truth, map_from_base_link, goes to `<log>.groundtruth.tum`. A reading whose clock runs backwards and what
/// cannot be read is left out and named; of a bag that is cut off, what comes before the cut is taken. Throws
/// std::runtime_error naming file and reason: no calibration, no image.
ImportReport importOpenLoris(const std::filesystem::path& directory_or_bag, const std::filesystem::path& log,
                             const std::function<void(double share)>& progress = {});

}  // namespace vmcl

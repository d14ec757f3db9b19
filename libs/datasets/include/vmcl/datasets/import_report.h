// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vmcl {

/// What an importer found.
struct ImportReport {
  int images = 0;
  int depth_images = 0;
  int scans = 0;
  int odometry_readings = 0;
  int ground_truth_poses = 0;
  std::vector<std::string> problems;  ///< what was left out, one line each: file, place and reason
};

}  // namespace vmcl

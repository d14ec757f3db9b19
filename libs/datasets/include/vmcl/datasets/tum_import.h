// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace vmcl {

struct TumImportOptions {
  int first_frame = 0;                               ///< first image taken, counting the lines of rgb.txt from 0
  int last_frame = std::numeric_limits<int>::max();  ///< last image taken

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

struct TumImportReport {
  int images = 0;
  int depth_images = 0;  ///< joined to one of them
  int odometry_readings = 0;
  int ground_truth_poses = 0;
  int mask_rows_from_top = 0;         ///< of calibration.yaml; a rawlog has no place for it
  std::vector<std::string> problems;  ///< images left out, one line each: file, line and reason
};

/// Makes a rawlog, sorted by time, of a directory in the layout of the TUM RGB-D benchmark (Sturm et al. 2012):
/// rgb.txt and calibration.yaml; depth.txt (16 bit PNG files of 5000 units a metre, aligned with the colour images; an
/// image within 0.02 s of a colour image joins it), odometry.txt and groundtruth.txt where there are. The ground truth
/// goes to
/// `<log>.groundtruth.tum` beside the log. Poses up to a second before and after the images are kept. Throws
/// std::runtime_error naming file and line: rgb.txt or calibration.yaml missing or wrong, a bad pose, no image left.
TumImportReport importTum(const std::filesystem::path& directory, const std::filesystem::path& log,
                          const TumImportOptions& options = {}, const std::function<void(double share)>& progress = {});

}  // namespace vmcl

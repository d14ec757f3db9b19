// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace vmcl {

struct SimulationOptions {
  std::string session;                                          ///< one of those of the scene file; empty: the only one
  uint64_t seed = 1;                                            ///< of the sensors' noise
  double duration = std::numeric_limits<double>::infinity();    ///< at most this long (s)
  std::filesystem::path simplemap = {};                         ///< also written, if not empty
  std::vector<std::filesystem::path> include_directories = {};  ///< where included scenes are looked for

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

struct SimulationReport {
  double duration = 0;  ///< s
  double way = 0;       ///< m
  int images = 0;
  int scans = 0;
  int odometry_readings = 0;
  int map_frames = 0;                       ///< places in the simplemap
  std::vector<std::string> missing_images;  ///< of meshes, which were drawn in their plain colour
};

/// Drives a robot with cameras, 2D laser ("laser") and wheel odometry ("odometry") through the furnished rooms of a
/// scene file (doc/file_formats.md). Writes the rawlog `log`, its images outside, and beside it
/// `<log>.groundtruth.tum`, the true map_from_robot. The simplemap holds the true poses with a camera image (inside the
/// file) and a scan each, every 0.15 m or 8 deg. The same options give the same bytes on one machine. Throws
/// std::runtime_error naming file and reason: a scene with an unknown key or a missing mesh, a path through a wall, no
/// way to draw off-screen.
SimulationReport simulate(const std::filesystem::path& scene_file, const std::filesystem::path& log,
                          const SimulationOptions& options, const std::function<void(double share)>& progress = {});

}  // namespace vmcl

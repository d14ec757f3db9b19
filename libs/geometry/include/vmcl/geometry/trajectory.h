// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// A pose at a time (seconds).
struct StampedPose {
  double time = 0;
  Rigid3 map_from_robot = Rigid3::Identity();
};

/// Poses in strictly increasing time.
class Trajectory {
 public:
  Trajectory() = default;

  /// Throws std::invalid_argument if the times do not increase strictly or a value is not finite.
  explicit Trajectory(std::vector<StampedPose> poses);

  const std::vector<StampedPose>& poses() const { return poses_; }
  bool empty() const { return poses_.empty(); }

  /// Linear in position, slerp in rotation; nothing outside the covered time or across a gap over `max_gap` seconds.
  std::optional<Rigid3> at(double time, double max_gap = 0.5) const;

 private:
  std::vector<StampedPose> poses_;
};

/// Reads the TUM format, a line `time tx ty tz qx qy qz qw` each, # comments. Throws std::runtime_error naming file,
/// line and reason.
Trajectory readTumTrajectory(const std::filesystem::path& file);

/// Writes the TUM format (times and poses with enough digits to read back the same), aside and then renamed.
void writeTumTrajectory(const std::filesystem::path& file, const Trajectory& trajectory);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// A pose of the robot as far as it is known: a Gaussian, in the map.
struct PoseWithCovariance {
  PlanarPose robot_in_map;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi): m, m, rad

  /// Throws std::invalid_argument: a value that is not finite or beyond 10,000 km, or a covariance that is not
  /// symmetric positive semidefinite or goes beyond 1e14 m^2.
  void check() const;

  /// A source of poses drawn from it, for as long as `random` lives.
  std::function<PlanarPose()> sampler(Random& random) const;
};

/// Writes it for the next start, as YAML: `robot_in_map: [x, y, phi]` and `covariance: [9 numbers]`, exact to the bit.
/// Throws std::runtime_error naming the file.
void savePose(const std::filesystem::path& file, const PoseWithCovariance& pose);

/// Reads what savePose() wrote. Throws std::runtime_error naming the file and what is wrong with it.
PoseWithCovariance loadPose(const std::filesystem::path& file);

}  // namespace vmcl

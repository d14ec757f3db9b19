// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Density of a weighted set of poses, 1/(m^2 rad): a sparse histogram, linear between its cells both when a pose is
/// put in and when the density is read. That is a kernel estimate with a kernel of variance cell^2 / 3 along each axis,
/// in time proportional to the number of poses.
class PoseDensity {
 public:
  static constexpr double cell_position = 0.10;  ///< m
  static constexpr int cells_per_turn = 72;
  static constexpr double cell_heading = 2 * std::numbers::pi / cells_per_turn;  ///< rad

  static constexpr double position_variance = cell_position * cell_position / 3;  ///< of the kernel, m^2
  static constexpr double heading_variance = cell_heading * cell_heading / 3;     ///< of the kernel, rad^2

  void add(const PlanarPose& pose, double weight);
  double operator()(const PlanarPose& pose) const;

 private:
  template <typename Visit>
  static void visitCellsAround(const PlanarPose& pose, Visit&& visit);

  std::unordered_map<uint64_t, double> cells_;
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

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

  /// One cell of the hash table, which is searched from where the key's hash points to on (open addressing).
  struct Cell {
    uint64_t key = no_key;
    double mass = 0;
  };
  static constexpr uint64_t no_key = ~uint64_t{0};  ///< of no pose: its heading would be beyond a turn

  std::size_t slotOf(uint64_t key) const;
  void grow();

  std::vector<Cell> cells_{Cell{}, Cell{}};  ///< a power of two, at least half of them free
  std::size_t used_ = 0;
};

}  // namespace vmcl

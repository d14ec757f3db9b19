// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <numbers>
#include <vector>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// A range of planar poses in the map: metres and radians.
struct PoseBox {
  double min_x = 0;
  double max_x = 0;
  double min_y = 0;
  double max_y = 0;
  double min_phi = -std::numbers::pi;
  double max_phi = std::numbers::pi;

  /// Throws std::invalid_argument naming the value that is not finite or beyond 10,000 km, or the range whose minimum
  /// exceeds its maximum.
  void check() const;
};

/// Where the robot may be when nothing else is known: a uniform density over a box, or over the cells in it that a grid
/// map knows to be free.
class PoseRegion {
 public:
  explicit PoseRegion(const PoseBox& box);

  /// Cells free with at least the probability that pf-localization asks for, 0.7. Throws std::invalid_argument when no
  /// cell of the box is free.
  PoseRegion(const PoseBox& box, const mrpt::maps::COccupancyGridMap2D& grid);

  PlanarPose draw(Random& random) const;

  /// Whether the position lies within the box, free or not.
  bool covers(const PlanarPose& pose) const {
    return pose.x >= box_.min_x && pose.x <= box_.max_x && pose.y >= box_.min_y && pose.y <= box_.max_y;
  }

  /// One over the density: m^2 rad. 0 for a single pose.
  double volume() const { return volume_; }

 private:
  PoseBox box_;
  std::vector<Eigen::Vector2f> free_cells_;  ///< centres; empty: the whole box
  double resolution_ = 0;                    ///< of the grid, m
  double volume_ = 0;
};

}  // namespace vmcl

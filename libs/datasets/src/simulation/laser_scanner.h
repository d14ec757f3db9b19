// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "triangles.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// A 2D laser: rays over a fan in the xy plane of its frame, from right to left.
struct LaserModel {
  int rays = 361;
  double aperture = 3.14159265358979;  ///< rad, from the first to the last ray
  double max_range = 12;               ///< m; what is farther gives no reading
  double sigma = 0.01;                 ///< standard deviation of a range (m)

  double angle(int ray) const { return rays == 1 ? 0 : aperture * (static_cast<double>(ray) / (rays - 1) - 0.5); }
};

/// Distances (m) along the rays to the first triangle, infinite where there is none. Each triangle is cut with the
/// plane of the scan; the cut covers the rays between its two ends.
class LaserSweep {
 public:
  LaserSweep(const LaserModel& laser, const Rigid3& map_from_laser);

  void add(const std::vector<Triangle>& triangles);

  /// The ranges as the laser measures them; nothing where a ray gives no reading.
  std::vector<std::optional<double>> measure(Random& random) const;

  const std::vector<double>& distances() const { return distances_; }

 private:
  void addCut(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

  LaserModel laser_;
  Rigid3 laser_from_map_;
  std::vector<Eigen::Vector2d> directions_;
  std::vector<double> distances_;
};

}  // namespace vmcl

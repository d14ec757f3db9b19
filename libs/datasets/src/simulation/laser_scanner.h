// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "scene.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// Distance (m) along a horizontal ray from map_from_ray, along its x axis at the height given, to the first solid.
/// Inside of a solid: 0. Nothing if there is none.
std::optional<double> castRay(const std::vector<Solid>& solids, const PlanarPose& map_from_ray, double height);

/// A 2D laser: rays over a horizontal fan, from right to left.
struct LaserModel {
  int rays = 361;
  double aperture = 3.14159265358979;  ///< rad, from the first to the last ray
  double max_range = 12;               ///< m; what is farther gives no reading
  double sigma = 0.01;                 ///< standard deviation of a range (m)

  double angle(int ray) const { return rays == 1 ? 0 : aperture * (static_cast<double>(ray) / (rays - 1) - 0.5); }
};

/// Ranges of all rays; nothing where a ray gives no reading.
std::vector<std::optional<double>> scan(const std::vector<Solid>& solids, const LaserModel& laser,
                                        const PlanarPose& map_from_laser, double height, Random& random);

}  // namespace vmcl

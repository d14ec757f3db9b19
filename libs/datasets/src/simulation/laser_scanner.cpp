// SPDX-License-Identifier: BSD-3-Clause
#include "laser_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vmcl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where a line is within [-half, half]: the interval of t with |start + t direction| <= half.
struct Interval {
  double enter = -infinity;
  double leave = infinity;
};

Interval slab(double start, double direction, double half) {
  if (direction == 0) return std::abs(start) <= half ? Interval{} : Interval{infinity, -infinity};
  const double a = (-half - start) / direction, b = (half - start) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/// Distance to a solid's footprint, infinite if it is missed.
double distanceAlongRay(const Solid& solid, const PlanarPose& map_from_ray) {
  const PlanarPose ray = inverse(solid.map_from_solid) * map_from_ray;
  const Interval x = slab(ray.x, std::cos(ray.phi), solid.half_size.x());
  const Interval y = slab(ray.y, std::sin(ray.phi), solid.half_size.y());
  const double enter = std::max(x.enter, y.enter), leave = std::min(x.leave, y.leave);
  return enter <= leave && leave >= 0 ? std::max(enter, 0.0) : infinity;
}

}  // namespace

std::optional<double> castRay(const std::vector<Solid>& solids, const PlanarPose& map_from_ray, double height) {
  double nearest = infinity;
  for (const Solid& solid : solids)
    if (solid.bottom <= height && height <= solid.top)
      nearest = std::min(nearest, distanceAlongRay(solid, map_from_ray));
  if (nearest == infinity) return std::nullopt;
  return nearest;
}

std::vector<std::optional<double>> scan(const std::vector<Solid>& solids, const LaserModel& laser,
                                        const PlanarPose& map_from_laser, double height, Random& random) {
  std::vector<std::optional<double>> ranges;
  for (int ray = 0; ray < laser.rays; ++ray) {
    auto range = castRay(solids, map_from_laser * PlanarPose{0, 0, laser.angle(ray)}, height);
    const double noise = laser.sigma * random.normal();  // drawn for every ray, so that scans stay comparable
    if (range) *range = std::max(0.0, *range + noise);
    ranges.push_back(range && *range <= laser.max_range ? range : std::nullopt);
  }
  return ranges;
}

}  // namespace vmcl

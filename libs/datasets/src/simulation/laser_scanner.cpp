// SPDX-License-Identifier: BSD-3-Clause
#include "laser_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double edge_tolerance = 1e-9;  // of a cut's length: no ray slips through between two triangles

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

LaserSweep::LaserSweep(const LaserModel& laser, const Rigid3& map_from_laser)
    : laser_(laser),
      laser_from_map_(map_from_laser.inverse()),
      distances_(static_cast<std::size_t>(laser.rays), infinity) {
  for (int ray = 0; ray < laser.rays; ++ray)
    directions_.emplace_back(std::cos(laser.angle(ray)), std::sin(laser.angle(ray)));
}

void LaserSweep::add(const std::vector<Triangle>& triangles) {
  const Vector3d up = laser_from_map_.linear().row(2);
  const double offset = laser_from_map_.translation().z();
  for (const Triangle& triangle : triangles) {
    std::array<double, 3> height{};
    for (int i = 0; i < 3; ++i) height[i] = up.dot(triangle.corners[i]) + offset;
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    if (*low > 0 || *high < 0 || *low == *high) continue;
    std::array<Vector2d, 3> ends;
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if ((height[i] > 0) == (height[j] > 0)) continue;
      const double share = height[i] / (height[i] - height[j]);
      const Vector3d crossing = triangle.corners[i] + share * (triangle.corners[j] - triangle.corners[i]);
      ends[count++] = (laser_from_map_ * crossing).head<2>();
    }
    if (count == 2) addCut(ends[0], ends[1]);
  }
}

void LaserSweep::addCut(const Vector2d& a, const Vector2d& b) {
  const double start = std::atan2(a.y(), a.x());
  const double sweep = std::remainder(std::atan2(b.y(), b.x()) - start, 2 * std::numbers::pi);
  const double step = laser_.rays == 1 ? 1 : laser_.aperture / (laser_.rays - 1);
  const Vector2d along = b - a;
  for (const double turn : {-2 * std::numbers::pi, 0.0, 2 * std::numbers::pi}) {
    const double from = std::min(start, start + sweep) + turn, to = std::max(start, start + sweep) + turn;
    const double first = (from - laser_.angle(0)) / step, last = (to - laser_.angle(0)) / step;
    if (last < -1 || first > laser_.rays) continue;
    const int end = std::min(laser_.rays - 1, static_cast<int>(std::ceil(last)));
    for (int ray = std::max(0, static_cast<int>(std::floor(first))); ray <= end; ++ray) {
      const Vector2d& direction = directions_[static_cast<std::size_t>(ray)];
      const double slant = cross(direction, along);
      if (slant == 0) continue;
      const double place = cross(a, direction) / slant, distance = cross(a, along) / slant;
      if (distance >= 0 && place >= -edge_tolerance && place <= 1 + edge_tolerance)
        distances_[static_cast<std::size_t>(ray)] = std::min(distances_[static_cast<std::size_t>(ray)], distance);
    }
  }
}

std::vector<std::optional<double>> LaserSweep::measure(Random& random) const {
  std::vector<std::optional<double>> ranges;
  for (const double distance : distances_) {
    const double noise = laser_.sigma * random.normal();  // drawn for every ray, so that scans stay comparable
    const double range = std::max(0.0, distance + noise);
    ranges.push_back(range <= laser_.max_range ? std::optional(range) : std::nullopt);
  }
  return ranges;
}

}  // namespace vmcl

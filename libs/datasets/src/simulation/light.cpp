// SPDX-License-Identifier: BSD-3-Clause
#include "light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float off_surface = 0.06f;    // m from a surface that rays start, past pictures and other thin things on it
constexpr float reach = 1.5f;           // m over which things darken each other
constexpr double lamp_power = 2.6;      // m^2: a ceiling lamp lights the floor below it well
constexpr double window_power = 2.2;    // per m^2 of a window
constexpr double nearest_square = 0.5;  // m^2: a lamp is not brighter than from this distance
constexpr int patches = 2;              // of a lamp or window, along each side
constexpr float faint = 0.02f;          // light that makes no difference
constexpr int directions = 24;          // that openness is judged by

/// Directions around a normal, denser near it as their light counts more (a spiral: Vogel 1979).
std::array<Vector3f, directions> hemisphere() {
  std::array<Vector3f, directions> all;
  for (int i = 0; i < directions; ++i) {
    const double radius = std::sqrt((i + 0.5) / directions), angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    all[i] = Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)).cast<float>();
  }
  return all;
}

}  // namespace

LightTracer::LightTracer(const std::vector<Triangle>& triangles, const std::vector<Lamp>& lamps, const Light& light)
    : tree_(triangles), lamps_(lamps), light_(light) {}

double LightTracer::powerOf(const Lamp& lamp) const {
  if (lamp.kind == Lamp::Kind::lamp) return light_.lamps * lamp_power * lamp.power;
  const double area = 4 * lamp.half_right.norm() * lamp.half_up.norm();
  const Vector3d sun(std::cos(light_.daylight_azimuth), std::sin(light_.daylight_azimuth), 0);
  const double towards_sun = std::abs(lamp.half_right.cross(lamp.half_up).normalized().dot(sun));
  return light_.daylight * window_power * area * lamp.power * (0.6 + 0.8 * towards_sun);
}

float LightTracer::fromLamp(const Lamp& lamp, const Vector3f& point, const Vector3f& normal) const {
  const Vector3f center = lamp.center.cast<float>(), right = lamp.half_right.cast<float>(),
                 up = lamp.half_up.cast<float>(), axis = right.cross(up).normalized();
  const auto power = static_cast<float>(powerOf(lamp));
  if (power <= 0) return 0;
  float sum = 0;
  for (int i = 0; i < patches; ++i)
    for (int j = 0; j < patches; ++j) {
      const float x = (2.0f * static_cast<float>(i) + 1) / patches - 1,
                  y = (2.0f * static_cast<float>(j) + 1) / patches - 1;
      const Vector3f way = center + x * right + y * up - point;
      const float distance = way.norm();
      const Vector3f direction = way / std::max(distance, 1e-6f);
      const float incidence = normal.dot(direction);
      if (incidence <= 0) continue;
      const float emission = lamp.kind == Lamp::Kind::window ? std::abs(axis.dot(direction)) : 1.0f;
      const float strength = power * emission * incidence / (distance * distance + static_cast<float>(nearest_square));
      if (strength > faint && !tree_.firstHit(point, direction, distance - 2 * off_surface)) sum += strength;
    }
  return sum / (patches * patches);
}

float LightTracer::openness(const Vector3f& point, const Vector3f& normal) const {
  static const auto around = hemisphere();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitZ(), normal);
  float sum = 0;
  for (const Vector3f& direction : around) {
    const auto hit = tree_.firstHit(point, turn * direction, reach);
    sum += hit ? std::sqrt(*hit / reach) : 1;
  }
  return sum / directions;
}

float LightTracer::at(const Vector3d& point, const Vector3d& normal) const {
  const Vector3f n = normal.cast<float>().normalized();
  const Vector3f start = point.cast<float>() + off_surface * n;
  const double even = 1.2;  // where nobody placed a lamp
  const double rest = lamps_.empty() ? even : 0.5 * std::min(1.0, 0.2 + 0.5 * light_.lamps + 0.7 * light_.daylight);
  double sum = rest * openness(start, n);
  for (const Lamp& lamp : lamps_) sum += fromLamp(lamp, start, n);
  return static_cast<float>(most * (1 - std::exp(-sum * light_.brightness / most)));
}

}  // namespace vmcl

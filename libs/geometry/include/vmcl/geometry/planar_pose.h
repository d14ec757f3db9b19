// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vmcl {

/// Rigid transform in space; the variable's name says which: a_from_b maps points of frame b into frame a.
using Rigid3 = Eigen::Isometry3d;

inline constexpr double degree = std::numbers::pi / 180;  ///< in radians

/// Pose of a frame on the ground plane, usually map_from_robot: x, y in metres, phi (yaw, counter-clockwise seen from
/// above) in radians. Map and robot frames: x forward, y left, z up.
struct PlanarPose {
  double x = 0;
  double y = 0;
  double phi = 0;
};

/// The angle in (-pi, pi] that differs from `angle` by whole turns.
inline double wrapAngle(double angle) {
  if (angle > -std::numbers::pi && angle <= std::numbers::pi) return angle;  // remainder() takes its time
  const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
  return wrapped == -std::numbers::pi ? std::numbers::pi : wrapped;
}

/// a_from_c = a_from_b * b_from_c.
inline PlanarPose operator*(const PlanarPose& a_from_b, const PlanarPose& b_from_c) {
  const double c = std::cos(a_from_b.phi), s = std::sin(a_from_b.phi);
  return {a_from_b.x + c * b_from_c.x - s * b_from_c.y, a_from_b.y + s * b_from_c.x + c * b_from_c.y,
          wrapAngle(a_from_b.phi + b_from_c.phi)};
}

/// b_from_a of a_from_b.
inline PlanarPose inverse(const PlanarPose& a_from_b) {
  const double c = std::cos(a_from_b.phi), s = std::sin(a_from_b.phi);
  return {-(c * a_from_b.x + s * a_from_b.y), s * a_from_b.x - c * a_from_b.y, wrapAngle(-a_from_b.phi)};
}

/// The planar pose as a transform in space (z = 0, no tilt).
inline Rigid3 toRigid3(const PlanarPose& pose) {
  Rigid3 rigid = Rigid3::Identity();
  rigid.translate(Eigen::Vector3d(pose.x, pose.y, 0)).rotate(Eigen::AngleAxisd(pose.phi, Eigen::Vector3d::UnitZ()));
  return rigid;
}

/// Position on the ground and heading of the x axis; height and tilt are dropped.
inline PlanarPose planarPart(const Rigid3& a_from_b) {
  const auto R = a_from_b.linear();
  return {a_from_b.translation().x(), a_from_b.translation().y(), std::atan2(R(1, 0), R(0, 0))};
}

inline bool isFinite(const PlanarPose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi);
}

}  // namespace vmcl

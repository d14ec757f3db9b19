// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "vmcl/estimation/heading_roots.h"
#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"

namespace vmcl {

/// Up to two poses map_from_robot.
struct PlanarRoots {
  std::array<PlanarTransform, 2> roots;
  int count = 0;
};

/// 1P1DP: the planar pose from one match with depth and one without (Jiao et al. 2021, section III), for any origins of
/// the rays: one camera, several references, rigs (MC1P1DP) and earlier frames are the same equation.
///
/// The height of the point fixes where it lies on its ray, a = o_h + lambda f_h, hence t = X_h - R a. Put into the
/// coplanarity of the two rays of the other match that leaves A cos(phi) + B sin(phi) + C = 0. No root: the point is at
/// camera height (range unknown) or behind the camera, or the equation vanishes (no baseline, or both matches the
/// same).
inline PlanarRoots solveOnePointOneDepth(const RayToPoint& depth, const RayToRay& match) {
  PlanarRoots result;
  const Eigen::Vector3d& o = depth.ray_in_robot.origin;
  const Eigen::Vector3d& d = depth.ray_in_robot.direction;
  const Eigen::Vector3d& X = depth.point_in_map;
  const double lambda = (X.z() - o.z()) / d.z();
  if (!(lambda > 0) || !std::isfinite(lambda)) return result;
  const double ax = o.x() + lambda * d.x(), ay = o.y() + lambda * d.y();

  const Eigen::Vector3d& f = match.ray_in_robot.direction;
  const Eigen::Vector3d& g = match.ray_in_map.direction;
  const double ex = match.ray_in_robot.origin.x() - ax, ey = match.ray_in_robot.origin.y() - ay;
  const double kx = X.x() - match.ray_in_map.origin.x(), ky = X.y() - match.ray_in_map.origin.y();
  const double w = match.ray_in_robot.origin.z() - match.ray_in_map.origin.z();
  const auto cross = [](double px, double py, double qx, double qy) { return px * qy - py * qx; };
  const auto dot = [](double px, double py, double qx, double qy) { return px * qx + py * qy; };

  const double A = -g.z() * cross(f.x(), f.y(), kx, ky) + f.z() * cross(g.x(), g.y(), ex, ey) +
                   w * cross(f.x(), f.y(), g.x(), g.y());
  const double B =
      g.z() * dot(f.x(), f.y(), kx, ky) + f.z() * dot(g.x(), g.y(), ex, ey) - w * dot(f.x(), f.y(), g.x(), g.y());
  const double C = -g.z() * cross(f.x(), f.y(), ex, ey) + f.z() * cross(g.x(), g.y(), kx, ky);

  const double n = A * A + B * B;
  const double scale = f.squaredNorm() * g.squaredNorm() * (ex * ex + ey * ey + kx * kx + ky * ky);
  if (!(n > 1e-24 * scale) || !std::isfinite(n)) return result;
  solveHeading(A, B, C, [&](double c, double s) {
    result.roots[static_cast<std::size_t>(result.count++)] = {c, s, X.x() - (c * ax - s * ay),
                                                              X.y() - (s * ax + c * ay)};
  });
  return result;
}

}  // namespace vmcl

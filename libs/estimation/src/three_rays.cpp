// SPDX-License-Identifier: BSD-3-Clause
#include "three_rays.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

Eigen::Vector3d turned(const Eigen::Vector3d& v, double c, double s) {
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

/// Rows over (t_x, t_y, 1).
Eigen::Matrix3d constraints(const std::array<RayToRay, 3>& matches, double phi) {
  const double c = std::cos(phi), s = std::sin(phi);
  Eigen::Matrix3d rows;
  for (int i = 0; i < 3; ++i) {
    const auto& [query, reference] = matches[static_cast<std::size_t>(i)];
    const Eigen::Vector3d f = turned(query.direction.normalized(), c, s), g = reference.direction.normalized();
    const Eigen::Vector3d normal = g.cross(f);
    rows.row(i) << normal.x(), normal.y(), normal.dot(turned(query.origin, c, s) - reference.origin);
  }
  return rows;
}

double rootBetween(const std::array<RayToRay, 3>& matches, double low, double high, double at_low) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high), at_middle = constraints(matches, middle).determinant();
    if ((at_middle > 0) == (at_low > 0))
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<PlanarTransform> solveThreeRays(const std::array<RayToRay, 3>& matches) {
  constexpr int steps = 48;  // two roots nearer than this are a double root up to noise
  constexpr double step = 2 * std::numbers::pi / steps;
  std::vector<PlanarTransform> poses;
  double before = constraints(matches, 0).determinant();
  for (int i = 1; i <= steps; ++i) {
    const double after = constraints(matches, i * step).determinant();
    if ((before > 0) != (after > 0)) {
      const double phi = rootBetween(matches, (i - 1) * step, i * step, before);
      const Eigen::Matrix3d rows = constraints(matches, phi);
      const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, 2>> position(rows.leftCols<2>());
      if (position.rank() == 2) {
        const Eigen::Vector2d t = position.solve(-rows.col(2));
        poses.emplace_back(std::cos(phi), std::sin(phi), t.x(), t.y());
      }
    }
    before = after;
  }
  return poses;
}

}  // namespace vmcl

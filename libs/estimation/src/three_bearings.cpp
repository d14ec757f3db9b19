// SPDX-License-Identifier: BSD-3-Clause
#include "three_bearings.h"

#include <Eigen/Dense>

#include "vmcl/estimation/heading_roots.h"

namespace vmcl {

PlanarRoots solveThreeBearings(const std::array<RayToPoint, 3>& matches) {
  Eigen::Matrix<double, 3, 2> bearing, origin, point;
  for (int i = 0; i < 3; ++i) {
    const auto& [ray, X] = matches[static_cast<std::size_t>(i)];
    bearing.row(i) = ray.direction.head<2>().normalized();
    origin.row(i) = ray.origin.head<2>();
    point.row(i) = X.head<2>();
  }
  const auto cross = [&](const auto& to) -> Eigen::Vector3d {
    return bearing.col(0).cwiseProduct(to.col(1)) - bearing.col(1).cwiseProduct(to.col(0));
  };
  Eigen::Matrix<double, 3, 2> turned;  // point, by a quarter to the right: R^T X = cos X + sin turned
  turned << point.col(1), -point.col(0);
  const Eigen::Vector3d by_cos = cross(point), by_sin = cross(turned), rest = -cross(origin);
  const Eigen::Vector3d without_translation = Eigen::Vector3d(bearing.col(0)).cross(Eigen::Vector3d(bearing.col(1)));
  const double A = without_translation.dot(by_cos), B = without_translation.dot(by_sin);
  PlanarRoots result;
  if (!(A * A + B * B > 1e-24 * point.squaredNorm())) return result;
  Eigen::Matrix<double, 3, 2> by_translation;
  by_translation << -bearing.col(1), bearing.col(0);
  const Eigen::Matrix2d normal = by_translation.transpose() * by_translation;
  solveHeading(A, B, without_translation.dot(rest), [&](double c, double s) {
    const Eigen::Vector2d moved = -(normal.inverse() * by_translation.transpose() * (c * by_cos + s * by_sin + rest));
    const Eigen::Matrix<double, 3, 2> seen = ((c * point + s * turned).rowwise() + moved.transpose()) - origin;
    if (!(bearing.cwiseProduct(seen).rowwise().sum().minCoeff() > 0)) return;
    result.roots[static_cast<std::size_t>(result.count++)] = {c, s, -(c * moved.x() - s * moved.y()),
                                                              -(s * moved.x() + c * moved.y())};
  });
  return result;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "upright_points.h"

#include <algorithm>
#include <cmath>

namespace vmcl {

std::vector<Rigid3> solveUprightPoints(const RayToPoint& first, const RayToPoint& second) {
  const Ray &one = first.ray_in_robot, &two = second.ray_in_robot;
  const Eigen::Vector3d D = first.point_in_map - second.point_in_map, o = one.origin - two.origin;
  if (!(D.head<2>().norm() > 1e-6 * D.norm())) return {};
  // lambda = lambda_0 + s n solves one.z lambda_1 - two.z lambda_2 = D.z - o.z.
  const Eigen::Vector2d across(one.direction.z(), -two.direction.z()), n(two.direction.z(), one.direction.z());
  const Eigen::Vector2d lambda_0 = across * ((D.z() - o.z()) / across.squaredNorm());
  // On the ground, the robot sees the second point to the first along A + s B.
  const auto between = [&](const Eigen::Vector2d& lambda) -> Eigen::Vector2d {
    return lambda[0] * one.direction.head<2>() - lambda[1] * two.direction.head<2>();
  };
  const Eigen::Vector2d A = o.head<2>() + between(lambda_0), B = between(n);
  const double a = B.squaredNorm(), b = A.dot(B), c = A.squaredNorm() - D.head<2>().squaredNorm();
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  std::vector<Rigid3> poses;
  for (const double s : {(-b - root) / a, (-b + root) / a}) {
    const Eigen::Vector2d lambda = lambda_0 + s * n, seen = A + s * B;
    if (!(lambda.minCoeff() > 0) || !std::isfinite(s)) continue;
    const double phi = std::atan2(D.y(), D.x()) - std::atan2(seen.y(), seen.x());
    Rigid3 pose(Eigen::AngleAxisd(phi, Eigen::Vector3d::UnitZ()));
    pose.translation() = first.point_in_map - pose.linear() * (one.origin + lambda[0] * one.direction);
    if (pose.matrix().allFinite()) poses.push_back(pose);
  }
  return poses;
}

}  // namespace vmcl

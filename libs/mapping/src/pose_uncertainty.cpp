// SPDX-License-Identifier: BSD-3-Clause
#include "pose_uncertainty.h"

#include <algorithm>

namespace vmcl {
namespace {

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

double epipolarArcDistance(const Eigen::Vector3d& first_ray, const Eigen::Vector3d& second_ray,
                           const Rigid3& second_from_first, double min_depth) {
  const Eigen::Vector3d far = second_from_first.linear() * first_ray;
  const Eigen::Vector3d near = (second_from_first * (min_depth * first_ray)).normalized();
  const Eigen::Vector3d normal = far.cross(near);
  const bool beside_arc = normal.dot(far.cross(second_ray)) >= 0 && normal.dot(second_ray.cross(near)) >= 0;
  if (beside_arc && normal.norm() > 1e-9)
    return std::asin(std::min(1.0, std::abs(normal.normalized().dot(second_ray))));
  return std::min(angleBetween(second_ray, far), angleBetween(second_ray, near));
}

}  // namespace vmcl

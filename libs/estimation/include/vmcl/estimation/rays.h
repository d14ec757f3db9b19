// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vmcl {

/// A half line: points origin + lambda * direction, lambda > 0. The direction need not be of length 1.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// 2D-3D match as the solvers see it (the paper's DP): the query ray in robot axes and the scene point it meets.
struct RayToPoint {
  Ray ray_in_robot;
  Eigen::Vector3d point_in_map;
};

/// 2D-2D match as the solvers see it (the paper's P): the query ray in robot axes and the reference ray it meets.
struct RayToRay {
  Ray ray_in_robot;
  Ray ray_in_map;
};

}  // namespace vmcl

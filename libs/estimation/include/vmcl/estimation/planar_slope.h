// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vmcl {

/// The likelihood about a planar pose: L, its gradient over (x, y, phi) in the map frame (m, m, rad), and the
/// Gauss-Newton information, the matches weighted by their chance of being inliers.
struct PlanarSlope {
  double log_likelihood = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

}  // namespace vmcl

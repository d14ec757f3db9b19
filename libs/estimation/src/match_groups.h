// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vmcl {

/// Matches with depth seen by one query camera.
struct PointGroup {
  int query = 0;
  std::vector<int> match;  ///< index in the problem
  std::vector<Eigen::Vector2d> pixel;
  std::vector<Eigen::Vector3d> point_in_map;
  std::vector<Eigen::Matrix3d> covariance;
  std::vector<double> outlier_density;  ///< at the pixel, over one uniform in the image
};

/// Matches without depth between one query and one reference camera.
struct RayGroup {
  int query = 0;
  int reference = 0;
  std::vector<int> match;
  std::vector<Eigen::Vector2d> query_pixel;
  std::vector<Eigen::Vector2d> reference_pixel;
  std::vector<double> outlier_density;  ///< at the query pixel, over one uniform in the image
};

}  // namespace vmcl

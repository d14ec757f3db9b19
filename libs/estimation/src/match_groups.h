// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Matches with depth seen by one query camera.
struct PointGroup {
  int query = 0;
  std::vector<int> match;  ///< index in the problem
  std::vector<Eigen::Vector2d> pixel;
  std::vector<Eigen::Vector3d> point_in_map;
  std::vector<Eigen::Matrix3d> covariance;
  std::vector<double> worth;  ///< of a likelihood ratio against outliers uniform in the image
};

/// Matches without depth between one query and one reference camera.
struct RayGroup {
  int query = 0;
  int reference = 0;
  std::vector<int> match;
  std::vector<Eigen::Vector2d> query_pixel;
  std::vector<Eigen::Vector2d> reference_pixel;
  std::vector<double> worth;
};

/// The matches of a problem, those evaluated alike together.
struct MatchGroups {
  explicit MatchGroups(const PoseProblem& problem);

  /// What a match's likelihood ratio against outliers that are uniform in the image is to be multiplied with: the odds
  /// of the match over the density of outliers at its pixel. By index of the match; 1 until set.
  void setWorth(const std::vector<double>& worth);

  std::vector<QueryCamera> query_cameras;
  std::vector<ReferenceCamera> reference_cameras;
  std::vector<PointGroup> points;
  std::vector<RayGroup> rays;
  int match_count = 0;
};

}  // namespace vmcl

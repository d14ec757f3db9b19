// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Which minimal samples are drawn: one match with depth and one without (1P1DP), two with depth (2DP), three without
/// depth that see two references or more, or, by choice of the matches, the first two kinds or else the third. The
/// bearings alone of three with depth only on request: where all points are within 0.02 to 0.5 m of the camera's
/// height, the case that they are for, they find the pose 0 to 1 % more often than the first two kinds do. Three with
/// depth, bearings and elevations, only where the robot is not bound to the ground.
enum class Solver {  // maps keep the numbers of the first three
  automatic = 0,
  one_point_one_depth = 1,
  two_depth = 2,
  three_rays,
  three_bearings,
  three_depth
};

/// "auto", "1p1dp", "2dp", "3p", "3b" or "3dp".
std::string_view nameOf(Solver solver);

/// A place where the robot may be: one peak of the likelihood, or several close together.
struct PoseMode {
  PlanarPose robot_in_map;
  double roll = 0, pitch = 0, height = 0;                ///< off the plane, of the heaviest peak: rad, m; 0 if held
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi), map frame: m, m, rad
  double log_likelihood = 0;                             ///< L at the heaviest peak
  double log_evidence = 0;                               ///< log odds that the robot is here against chance
  double log_weight = 0;                                 ///< log of its share of the mixture, <= 0
  std::vector<int> inliers;                              ///< matches more likely inlier than outlier, by index
  Solver solver = Solver::automatic;                     ///< kind of the sample that led here
};

/// (x, y, phi) of b minus a, the angle wrapped.
Eigen::Vector3d difference(const PlanarPose& b, const PlanarPose& a);

/// Joins modes of one place, within 3 sigma or 0.1 m and 1.7 deg of each other and as far off the plane, into one with
/// the moments of their mixture, each peak (0.5 sigma) counted once; keeps the `max_modes` of most evidence and
/// normalizes their weights.
std::vector<PoseMode> mergeModes(std::vector<PoseMode> modes, int max_modes);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// A camera of the robot that is to be localized. A rig has several; frames seen earlier and moved here by odometry
/// count as further cameras of the rig.
struct QueryCamera {
  PinholeCamera camera;
  Rigid3 robot_from_camera = Rigid3::Identity();
};

/// A camera of the map, at a known pose.
struct ReferenceCamera {
  PinholeCamera camera;
  Rigid3 map_from_camera = Rigid3::Identity();
};

/// Position of a scene point and how well it is known, map frame, metres.
struct MapPoint {
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// One correspondence between a query and a reference image. With a point it is a 2D-3D match (the paper's DP),
/// without one a 2D-2D match (P): leave the point out where its depth is not reliable.
struct Match {
  int query_camera = 0;
  Eigen::Vector2d query_pixel = Eigen::Vector2d::Zero();
  int reference_camera = 0;
  Eigen::Vector2d reference_pixel = Eigen::Vector2d::Zero();
  std::optional<MapPoint> point;
  /// Odds that this match is an inlier over those of a match of which no more is known: of how distinctive it is, or
  /// how sure its detector. In [0.001, 1000].
  double inlier_odds = 1;
};

/// All that is known for one pose: find robot_in_map = map_from_robot.
struct PoseProblem {
  std::vector<QueryCamera> query_cameras;
  std::vector<ReferenceCamera> reference_cameras;
  std::vector<Match> matches;

  /// Throws std::invalid_argument naming the entry: bad camera, camera index out of range, rotation not orthonormal
  /// (1e-6), a value that is not finite, a covariance that is not symmetric positive semidefinite, odds out of range.
  void check() const;
};

}  // namespace vmcl

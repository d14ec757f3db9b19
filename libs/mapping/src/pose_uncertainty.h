// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Standard deviations of where the views of the map are thought to be.
struct PoseUncertainty {
  double position = 0;    ///< m
  double heading = 0;     ///< rad
  double tilt = 0;        ///< of the robot's roll and pitch (rad)
  double mount_tilt = 0;  ///< of a camera on the robot, common to its views (rad)

  /// Standard deviation (rad) of the direction in which a point at `depth` (m) is seen, in views that differ by
  /// `view_difference` (rad): a common tilt shows only as far as the views differ.
  double ofDirection(double depth, double view_difference) const {
    return Eigen::Vector4d(heading, tilt, position / depth, mount_tilt * view_difference).norm();
  }
};

/// Angle (rad) between a ray of the second view and the arc of directions in which that view sees the points at
/// min_depth (m) to infinity on a ray of the first: the epipolar constraint with the side and the nearness of the
/// point, which holds for a pure rotation too. Rays are unit vectors in their own view.
double epipolarArcDistance(const Eigen::Vector3d& first_ray, const Eigen::Vector3d& second_ray,
                           const Rigid3& second_from_first, double min_depth);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Fisher information that one right match holds about the robot's (x, y, phi) at map_from_robot, for pixel noise of
/// `sigma_px` > 0 in either image: linear propagation of errors. The point lies before both cameras.

/// With depth: its query pixel and its point, whose error is that of its covariance. The reference pixel is what the
/// point was made from and counts no second time. Of rank 2.
Eigen::Matrix3d informationWithDepth(const QueryCamera& query, const PlanarPose& map_from_robot, const MapPoint& point,
                                     double sigma_px);

/// Without: its two pixels, for a point that may lie anywhere and in truth is there. Of rank 1, or 0 without baseline.
Eigen::Matrix3d informationWithoutDepth(const QueryCamera& query, const ReferenceCamera& reference,
                                        const PlanarPose& map_from_robot, const Eigen::Vector3d& point_in_map,
                                        double sigma_px);

}  // namespace vmcl

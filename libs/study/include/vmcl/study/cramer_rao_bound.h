// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vmcl/study/simulated_world.h"

namespace vmcl {

/// Fisher information about the robot's (x, y, phi) in the inliers, at the truth, for pixel noise of `sigma_px` > 0.
/// A match with depth is its query pixel and its point, whose error is that of its covariance; the reference pixel is
/// what the point was made from and counts no second time. A match without depth is its two pixels; where its point
/// lies is unknown and eliminated.
Eigen::Matrix3d fisherInformation(const SimulatedProblem& simulated, double sigma_px);

/// The least covariance of (x, y, phi), in m and rad, that an unbiased estimator could reach if it knew the inliers.
/// Nothing where they do not fix the pose.
std::optional<Eigen::Matrix3d> cramerRaoBound(const SimulatedProblem& simulated, double sigma_px);

}  // namespace vmcl

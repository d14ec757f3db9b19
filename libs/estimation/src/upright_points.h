// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Poses of an upright robot at any height that meet two matches with depth, at most two. Rays o_i + lambda_i f_i meet
/// points X_i: the heights of the points differ as those on the rays do, which leaves a line of (lambda_1, lambda_2),
/// and their distance on the ground is one on it that a quadratic gives; the heading turns one segment to the other.
/// None for points at one height with rays that are level, above each other, or behind the cameras.
std::vector<Rigid3> solveUprightPoints(const RayToPoint& first, const RayToPoint& second);

}  // namespace vmcl

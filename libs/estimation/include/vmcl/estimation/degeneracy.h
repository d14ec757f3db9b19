// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Configurations of matches that leave part of the pose to few of them.
enum class Degeneracy {
  no_baseline,  ///< the cameras stand where the references stood: matches without depth fix the heading alone
  horizon,      ///< points at the height of the camera: bearings to them, no ranges
  wall,         ///< points abreast at right angles to the baseline: 1P1DP has a double root
};

/// "no_baseline", "horizon" or "wall".
std::string_view nameOf(Degeneracy degeneracy);

/// Those that nine in ten of the given matches share, at this pose and pixel noise.
std::vector<Degeneracy> degeneracies(const PoseProblem& problem, const std::vector<int>& inliers,
                                     const PlanarPose& map_from_robot, double sigma_px);

}  // namespace vmcl

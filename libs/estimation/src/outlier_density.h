// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// How dense outliers are at each match, over a density uniform in the query image; by index of the match.
///
/// A camera that moves on a plane sees a point at whatever distance on the same side of the horizon, so that wrong
/// matches of a level world (repeated structure, things that moved) still agree in elevation, and many do so by chance
/// with any epipolar geometry. Outliers are a mixture of such, whose elevations in both images differ by a
/// log-normal factor, and of uniform ones; the share of the former and the spread of the factor are estimated from
/// the matches by expectation maximization, the share less that of the inliers, which are level, too.
std::vector<double> outlierDensity(const PoseProblem& problem, double inlier_prior);

}  // namespace vmcl

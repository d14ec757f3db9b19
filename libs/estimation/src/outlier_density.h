// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// How dense outliers are at each match, over a density uniform in the query image.
///
/// A camera that moves on a plane sees a point at whatever distance on the same side of the horizon, so that wrong
/// matches of a level world (repeated structure, things that moved) still agree in elevation, and many do so by chance
/// with any epipolar geometry. Outliers are a mixture of such, whose elevations in both images differ by a
/// log-normal factor, and of uniform ones; the share of the former and the spread of the factor are estimated from
/// the matches by expectation maximization.
class OutlierDensity {
 public:
  explicit OutlierDensity(const PoseProblem& problem);

  /// By index of the match. The inliers are level, too: of the other matches fewer are.
  std::vector<double> at(double inlier_prior) const;

 private:
  double share_;               ///< of all matches that are level
  std::vector<double> level_;  ///< density of level outliers at each match
};

}  // namespace vmcl

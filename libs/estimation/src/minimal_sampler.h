// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// Draws minimal samples from the matches of a problem and solves them.
class MinimalSampler {
 public:
  explicit MinimalSampler(const PoseProblem& problem);

  /// A match with depth and another match, taken without its depth.
  bool canDrawOnePointOneDepth() const { return !with_depth_.empty() && rays_.size() > 1; }
  bool canDrawTwoDepth() const { return with_depth_.size() > 1; }

  /// Each appends the poses of `count` samples.
  void drawOnePointOneDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const;
  /// All pairs instead, where there are no more than `count`.
  void drawTwoDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const;

 private:
  std::vector<RayToRay> rays_;  ///< of every match
  std::vector<RayToPoint> with_depth_;
  std::vector<int> match_of_depth_;  ///< index of with_depth_'s entries in rays_
};

}  // namespace vmcl

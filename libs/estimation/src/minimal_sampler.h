// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// Draws minimal samples from the matches of a problem and solves them.
class MinimalSampler {
 public:
  explicit MinimalSampler(const PoseProblem& problem);

  /// Whether there are matches enough for a sample of this kind.
  bool canDraw(Solver kind) const;
  /// How many different samples there are.
  double sampleCount(Solver kind) const;
  /// Chance that a sample holds no outlier, if these matches are the inliers (increasing indices).
  double chanceOfInliers(Solver kind, const std::vector<int>& inliers) const;

  /// Appends the poses of `count` samples; of all pairs with depth instead, where there are no more of them.
  void draw(Solver kind, int count, Random& random, std::vector<PlanarTransform>& poses) const;

 private:
  void drawOnePointOneDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const;
  void drawTwoDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const;
  void drawThreeRays(int count, Random& random, std::vector<PlanarTransform>& poses) const;

  std::vector<RayToRay> rays_;  ///< of every match
  bool has_baseline_ = false;   ///< rays of either side come from two places or more, 1 cm apart
  std::vector<RayToPoint> with_depth_;
  std::vector<int> match_of_depth_;  ///< index of with_depth_'s entries in rays_
};

}  // namespace vmcl

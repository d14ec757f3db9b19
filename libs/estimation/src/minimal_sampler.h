// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "even_order.h"
#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// Draws minimal samples from the matches of a problem and solves them.
class MinimalSampler {
 public:
  MinimalSampler(const PoseProblem& problem, uint64_t seed);

  /// Whether there are matches enough for a sample of this kind.
  bool canDraw(Solver kind) const;
  /// How many samples there are.
  double sampleCount(Solver kind) const;
  /// Chance that a sample holds no outlier, if these matches are the inliers (increasing indices).
  double chanceOfInliers(Solver kind, const std::vector<int>& inliers) const;

  /// Appends the poses of the next `count` samples of a kind that can be drawn: in random order, each once before any
  /// comes again.
  void draw(Solver kind, int count, std::vector<PlanarTransform>& poses);

 private:
  void addOnePointOneDepth(uint64_t sample, std::vector<PlanarTransform>& poses) const;
  void addTwoDepth(uint64_t sample, std::vector<PlanarTransform>& poses) const;
  void addThreeRays(uint64_t sample, std::vector<PlanarTransform>& poses) const;

  std::vector<RayToRay> rays_;  ///< of every match, shuffled
  bool has_baseline_ = false;   ///< rays of either side come from two places or more, 1 cm apart
  std::vector<RayToPoint> with_depth_;
  std::vector<std::size_t> ray_of_depth_;  ///< index of with_depth_'s entries in rays_
  std::vector<int> match_of_depth_;        ///< and in the problem
  Random random_;
  std::map<Solver, EvenOrder> orders_;
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "even_order.h"
#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"
#include "weighted_choice.h"

namespace vmcl {

/// Draws minimal samples from the matches of a problem and solves them.
class MinimalSampler {
 public:
  /// inlier_prior: chance that a match with odds 1 is an inlier.
  MinimalSampler(const PoseProblem& problem, double inlier_prior, uint64_t seed);

  /// Whether there are matches enough for a sample of this kind.
  bool canDraw(Solver kind) const;
  /// How many samples there are.
  double sampleCount(Solver kind) const;
  /// Chance that a sample as drawn holds no outlier, if these matches are the inliers (increasing indices).
  double chanceOfInliers(Solver kind, const std::vector<int>& inliers) const;

  /// Appends the poses of the next `count` samples of a kind that can be drawn, in random order: each once before any
  /// comes again or, where the matches' odds differ and samples are many, each member in proportion to its chance to be
  /// an inlier.
  void draw(Solver kind, int count, std::vector<PlanarTransform>& poses);

 private:
  /// A depth and a ray; two or three depths; three rays: indices into with_depth_ and rays_.
  using Members = std::array<std::size_t, 3>;
  Members membersOf(Solver kind, uint64_t sample) const;
  Members likelyMembers(Solver kind);
  bool drawsByOdds(Solver kind) const;
  void addPoses(Solver kind, const Members& members, std::vector<PlanarTransform>& poses) const;

  std::vector<RayToRay> rays_;  ///< of every match, shuffled
  std::vector<int> match_of_ray_;
  WeightedChoice ray_chances_, depth_chances_;  ///< that rays_ and with_depth_ are inliers
  bool has_odds_ = false;                       ///< which differ
  bool has_baseline_ = false;                   ///< rays of either side come from two places or more, 1 cm apart
  std::vector<RayToPoint> with_depth_;
  std::vector<std::size_t> ray_of_depth_;  ///< index of with_depth_'s entries in rays_
  Random random_;
  std::map<Solver, EvenOrder> orders_;
};

}  // namespace vmcl

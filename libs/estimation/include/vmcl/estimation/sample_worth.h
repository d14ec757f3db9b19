// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// How often matches are right, each in [0, 1] (Jiao et al. 2020, section IV-A).
struct MatchRates {
  double sparse_inliers = 0.3;  ///< lambda: of matches at features, where depth is
  double dense_inliers = 0.3;   ///< lambda_d: of matches that need no depth; equal to lambda without dense matches
  double reliable_depth = 1;    ///< gamma: of depths that count as reliable, those that are right

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Chance that a 1P1DP or 2DP sample holds right matches and depths alone: lambda_d (lambda gamma) or (lambda gamma)^2,
/// of which lambda_d = lambda is SCSD. Throws std::invalid_argument for other solvers.
double chanceOfGoodSample(Solver solver, const MatchRates& rates);

/// RANSAC's rule: so many samples that a good one is among them with this confidence in (0, 1), if each is with this
/// chance; infinite for none.
inline double samplesNeeded(double chance_of_good, double confidence = 0.999) {
  return std::ceil(std::log1p(-confidence) / std::log1p(-std::min(chance_of_good, confidence)));
}

/// A reference image as samples see it.
struct ReferenceView {
  ReferenceCamera camera;
  std::vector<MapPoint> points;  ///< of all its features; where one is unknown, a place where it may be
  std::size_t with_depth = 0;    ///< so many of the points, the first ones, count as reliable
};

/// Where the robot is, seen from the reference, when it looks at the same place: normal about the pose that the
/// reference image was taken at.
struct QuerySpread {
  PlanarPose map_from_robot;
  double sigma_position = 0.3;  ///< along either axis, m
  double sigma_heading = 0.2;   ///< rad
};

/// What counts as near enough to the truth for refinement to find it.
struct Tolerance {
  double position = 0.25;       ///< m
  double heading = 5 * degree;  ///< rad

  bool holds(const PlanarTransform& found, const PlanarPose& truth) const;
};

/// What one random sample is worth.
struct SampleWorth {
  double chance_good = 0;     ///< that its matches and depths are right
  double chance_within = 0;   ///< that the pose of a good one is within the tolerance
  double sigma_position = 0;  ///< of the pose of a good sample, root of the trace: the median of samples, m
  double sigma_heading = 0;   ///< likewise, rad

  /// That it leads to the truth.
  double chance() const { return chance_good * chance_within; }
};

/// At 256 query poses and pairs of points that are in sight from there, for one solver, 1P1DP or 2DP: the covariance by
/// linear propagation of pixel noise and of the points' covariances, the chance within tolerance by drawing such errors
/// and solving. All 0 where there are too few points or none is in
/// sight. The same arguments give the same answer. Throws std::invalid_argument for other solvers and bad rates.
SampleWorth sampleWorth(Solver solver, const ReferenceView& view, const QueryCamera& query, const QuerySpread& spread,
                        const MatchRates& rates, double sigma_px, const Tolerance& tolerance = {});

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/estimation/sample_worth.h"
#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/relocalization/relocalizer.h"
#include "vmcl/vision/solution_network.h"

namespace vmcl {

/// What samples of either solution are worth with matches of one keyframe.
struct SolutionAnalysis {
  MatchRates rates;
  SampleWorth one_point_one_depth, two_depth;

  /// The one whose sample rather leads to the truth; automatic where none ever does.
  Solver best() const;
};

/// From the keyframe's landmarks alone, those that count as reliable by the options: their places, covariances and
/// numbers of observations n: each but the first halves the chance that the depth is wrong, and so does a measured
/// depth. Inlier rates, which nobody knows before the query, are the estimator's prior; the noise of pixels is
/// MapBuilder's.
SolutionAnalysis analyzeSolutions(const KeyframeMap& map, const Keyframe& keyframe, const RelocalizerOptions& options);

/// Sets Keyframe::solution of all by the analysis.
void chooseByAnalysis(KeyframeMap& map, const RelocalizerOptions& options);

/// By a network, where the keyframe has landmarks; elsewhere by the analysis. Throws std::runtime_error when the
/// network fails.
void chooseByNetwork(KeyframeMap& map, const SolutionNetwork& network, const RelocalizerOptions& options);

/// For one solution or the other.
class SolutionVotes {
 public:
  void add(Solver solution) { lead_ += (solution == Solver::two_depth) - (solution == Solver::one_point_one_depth); }

  /// Automatic without votes and for as many either way.
  Solver winner() const {
    return lead_ == 0 ? Solver::automatic : lead_ > 0 ? Solver::two_depth : Solver::one_point_one_depth;
  }

 private:
  int lead_ = 0;  ///< of 2DP
};

/// What the keyframes that matches were found with say, each as often as it has matches; automatic if they say nothing
/// or both alike.
Solver chosenSolution(const KeyframeMap& map, const RelocalizationResult& matched);

}  // namespace vmcl

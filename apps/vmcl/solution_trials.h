// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/relocalization/solution_choice.h"

namespace vmcl {

/// 1P1DP's first, then 2DP's.
using OfBothSolutions = std::array<double, 2>;

/// Who solves the problems that are to show which solution is better.
enum class Judge {
  counting,   ///< the paper's RANSAC, which counts inliers
  likelihood  ///< estimatePose
};

/// An image matched with one keyframe alone.
struct SolutionTrial {
  double time = 0;  ///< of the image, s
  std::string label{};
  int keyframe = 0;
  std::size_t matches = 0, with_depth = 0;
  MatchRates rates{};           ///< inliers as the image's best pose shows them, depth as the keyframe does
  OfBothSolutions predicted{};  ///< chance that a sample leads to the truth
  OfBothSolutions observed{};   ///< share of samples that do
  std::array<std::optional<double>, 2> error{};  ///< distance of the pose found from the truth, m; nothing: none found

  /// The solution whose pose is nearer to the truth by over 0.25 m, and no farther than 1 m; automatic for neither.
  Solver better() const;
};

/// One for each keyframe that the image has matches with.
std::vector<SolutionTrial> solutionTrials(const Relocalizer& relocalizer, std::span<const SolutionAnalysis> analyses,
                                          const CameraObservation& observation, const PlanarPose& truth, Judge judge);

/// The solution that is better in most of the trials of each keyframe; automatic where there is none.
std::vector<Solver> labelsOf(std::span<const SolutionTrial> trials, std::size_t keyframes);

/// A line a trial.
void writeTrials(const std::filesystem::path& file, std::span<const SolutionTrial> trials);

/// Predicted and observed chances of a sample, by bins of the predicted, with 95 % intervals of the observed mean.
void printCalibration(std::span<const SolutionTrial> trials);

}  // namespace vmcl

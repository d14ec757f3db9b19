// SPDX-License-Identifier: BSD-3-Clause
#include "peer_methods.h"

#include <algorithm>

#include "vmcl/relocalization/solution_choice.h"

namespace vmcl {

PeerMethods::PeerMethods(const KeyframeMap& map, const RelocalizerOptions& options)
    : map_(map), options_(options), methods_(poseMethods()) {
  std::erase_if(methods_, [](const PoseMethod& method) { return !method.takes_rigs || method.name == "vmcl"; });
}

std::vector<std::pair<std::string, std::optional<PlanarPose>>> PeerMethods::poses(
    const RelocalizationResult& matched) const {
  std::vector<std::pair<std::string, std::optional<PlanarPose>>> found;
  const Solver chosen = chosenSolution(map_, matched);
  const auto addOurs = [&](const std::string& name, Solver solver) {
    EstimatorOptions options = options_.estimator;
    options.solver = solver;
    const PoseEstimate estimate = estimatePose(matched.problem, options);
    found.push_back({name, estimate.found() ? std::optional(estimate.modes.front().robot_in_map) : std::nullopt});
  };
  addOurs("vmcl 1p1dp", Solver::one_point_one_depth);
  addOurs("vmcl 2dp", Solver::two_depth);
  addOurs("vmcl both", Solver::automatic);
  addOurs("vmcl map", chosen);
  std::optional<PlanarPose> mix;
  for (const PoseMethod& method : methods_) {
    const std::vector<PlanarPose> poses = method.estimate(matched.problem, {.seed = options_.estimator.seed});
    const auto pose = poses.empty() ? std::nullopt : std::optional(poses.front());
    // Where the map says nothing, 1P1DP, which needs less depth.
    if (method.name == (chosen == Solver::two_depth ? "2DP" : "1P1DP")) mix = pose;
    found.push_back({method.name, pose});
  }
  found.push_back({"Mix", mix});
  return found;
}

std::vector<std::pair<int, int>> referencesOf(const RelocalizationResult& matched) {
  std::vector<std::pair<int, int>> references;
  for (const int keyframe : matched.keyframes) references.push_back({keyframe, 0});
  for (const Match& match : matched.problem.matches)
    ++references[static_cast<std::size_t>(match.reference_camera)].second;
  return references;
}

}  // namespace vmcl

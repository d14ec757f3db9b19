// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/solution_choice.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "largest_sigma.h"
#include "vmcl/mapping/heat_map.h"
#include "vmcl/mapping/map_builder.h"

namespace vmcl {
namespace {

/// A wrong one lives through each further view by a chance of one half. What is seen but once has a measured depth, as
/// good as another view.
double chanceOfRightDepth(const Landmark& landmark) {
  return 1 - std::exp2(1 - std::max(2, landmark.observation_count));
}

/// Points of a keyframe's features; how often their depths are right goes to `rates`.
ReferenceView referenceView(const KeyframeMap& map, const Keyframe& keyframe, const RelocalizerOptions& options,
                            MatchRates& rates) {
  ReferenceView view{map.referenceCamera(keyframe), {}, 0};
  const Eigen::Vector3d center = view.camera.map_from_camera.translation();
  std::vector<MapPoint> unreliable;
  std::vector<double> depths;
  std::vector<Eigen::Vector2d> unknown;
  double right = 0;
  for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i) {
    if (keyframe.landmark_of_feature[i] < 0) {
      unknown.push_back(keyframe.features.pixels[i].cast<double>());
      continue;
    }
    const Landmark& landmark = map.landmarks[static_cast<std::size_t>(keyframe.landmark_of_feature[i])];
    depths.push_back((view.camera.map_from_camera.inverse() * landmark.point_in_map).z());
    const bool is_reliable = largestSigma(landmark.covariance) <= options.max_point_sigma &&
                             (landmark.point_in_map - center).norm() <= options.reliable_depth;
    (is_reliable ? view.points : unreliable).push_back({landmark.point_in_map, landmark.covariance});
    if (is_reliable) right += chanceOfRightDepth(landmark);
  }
  view.with_depth = view.points.size();
  rates.reliable_depth = view.with_depth == 0 ? 0 : right / static_cast<double>(view.with_depth);
  view.points.insert(view.points.end(), unreliable.begin(), unreliable.end());
  for (std::size_t i = 0; i < unknown.size() && !depths.empty(); ++i) {  // as far as landmarks are, taken in turn
    const Eigen::Vector3d point = depths[i % depths.size()] * view.camera.camera.ray(unknown[i]);
    view.points.push_back({view.camera.map_from_camera * point, Eigen::Matrix3d::Zero()});
  }
  return view;
}

bool hasLandmarks(const Keyframe& keyframe) {
  return std::ranges::any_of(keyframe.landmark_of_feature, [](int landmark) { return landmark >= 0; });
}

}  // namespace

Solver SolutionAnalysis::best() const {
  const double one = one_point_one_depth.chance(), two = two_depth.chance();
  if (!(std::max(one, two) > 0)) return Solver::automatic;
  return two > one ? Solver::two_depth : Solver::one_point_one_depth;
}

SolutionAnalysis analyzeSolutions(const KeyframeMap& map, const Keyframe& keyframe, const RelocalizerOptions& options) {
  const LikelihoodOptions& prior = options.estimator.likelihood;
  SolutionAnalysis analysis;
  analysis.rates = {prior.inlier_prior, prior.inlier_prior, 0};
  const ReferenceView view = referenceView(map, keyframe, options, analysis.rates);
  const MapCamera& camera = map.cameras[static_cast<std::size_t>(keyframe.camera)];
  const QueryCamera query{camera.calibration.pinhole, camera.robot_from_camera};
  const QuerySpread spread{planarPart(keyframe.map_from_robot)};
  const auto worth = [&](Solver solver) {
    return sampleWorth(solver, view, query, spread, analysis.rates, MapBuilderOptions().sigma_px);
  };
  analysis.one_point_one_depth = worth(Solver::one_point_one_depth);
  analysis.two_depth = worth(Solver::two_depth);
  return analysis;
}

void chooseByAnalysis(KeyframeMap& map, const RelocalizerOptions& options) {
  for (Keyframe& keyframe : map.keyframes) keyframe.solution = analyzeSolutions(map, keyframe, options).best();
}

void chooseByNetwork(KeyframeMap& map, const SolutionNetwork& network, const RelocalizerOptions& options) {
  for (Keyframe& keyframe : map.keyframes) {
    if (!hasLandmarks(keyframe)) {
      keyframe.solution = analyzeSolutions(map, keyframe, options).best();
      continue;
    }
    const auto [one, two] = network(heatMap(map, keyframe, network.width(), network.height()).view());
    keyframe.solution = two > one ? Solver::two_depth : Solver::one_point_one_depth;
  }
}

Solver chosenSolution(const KeyframeMap& map, const RelocalizationResult& matched) {
  SolutionVotes votes;
  for (const Match& match : matched.problem.matches) {
    const int keyframe = matched.keyframes[static_cast<std::size_t>(match.reference_camera)];
    votes.add(map.keyframes[static_cast<std::size_t>(keyframe)].solution);
  }
  return votes.winner();
}

}  // namespace vmcl

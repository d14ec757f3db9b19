// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "dense_correspondences.h"
#include "inlier_odds.h"
#include "largest_sigma.h"
#include "match_candidate.h"
#include "place_ranking.h"
#include "reference_depth.h"
#include "vmcl/relocalization/solution_choice.h"
#include "vmcl/vision/place_index.h"
#include "vmcl/vision/place_network.h"

namespace vmcl {
namespace {

/// Adds the time since the last reading to one step.
class Stopwatch {
 public:
  void addTo(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::shared_ptr<const KeyframeMap> checked(std::shared_ptr<const KeyframeMap> map, const RelocalizerOptions& options) {
  options.check();
  if (map == nullptr || map->keyframes.empty() || map->place_descriptors.size() == 0)
    throw std::invalid_argument("the map is empty");
  map->check();
  if (options.setting != MatchSetting::scsd && !map->isDense())
    throw std::invalid_argument("the map is not dense, as " + std::string(nameOf(options.setting)) +
                                " needs it: make it with --dense");
  return map;
}

}  // namespace

std::string_view nameOf(MatchSetting setting) {
  return setting == MatchSetting::scsd ? "scsd" : setting == MatchSetting::dcsd ? "dcsd" : "dcdd";
}

MatchSetting matchSettingFromName(std::string_view name) {
  for (const MatchSetting setting : {MatchSetting::scsd, MatchSetting::dcsd, MatchSetting::dcdd})
    if (name == nameOf(setting)) return setting;
  throw std::invalid_argument("setting is \"" + std::string(name) + "\", not scsd, dcsd or dcdd");
}

void RelocalizerOptions::check() const {
  matching.check();
  estimator.check();
  const auto require = [](bool holds, const char* key, double value) {
    if (!holds) throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) + ", not positive");
  };
  require(retrieved >= 1, "retrieved", retrieved);
  if (ranked < 0) throw std::invalid_argument("ranked is " + std::to_string(ranked) + ", negative");
  require(reliable_depth > 0, "reliable_depth", reliable_depth);
  require(max_point_sigma > 0, "max_point_sigma", max_point_sigma);
}

PoseEstimate estimatePose(const PoseProblem& problem, const KeyframeMap& map, const EstimatorOptions& options) {
  PoseEstimate estimate = estimatePose(problem, options);
  for (PoseMode& mode : estimate.modes) {
    const Eigen::Matrix3d map_from_robot =
        Eigen::AngleAxisd(mode.robot_in_map.phi, Eigen::Vector3d::UnitZ()).toRotationMatrix();  // of (x, y, phi), too
    mode.covariance += map_from_robot * map.pose_covariance * map_from_robot.transpose();
  }
  return estimate;
}

PoseEstimate estimatePose(const RelocalizationResult& matched, const KeyframeMap& map,
                          const RelocalizerOptions& options) {
  EstimatorOptions estimator = options.estimator;
  if (options.solution_of_map) estimator.solver = chosenSolution(map, matched);
  return estimatePose(matched.problem, map, estimator);
}

struct Relocalizer::State {
  std::shared_ptr<const KeyframeMap> map;
  RelocalizerOptions options;
  FeatureExtractor extractor;
  std::optional<PlaceNetwork> place_network;
  std::optional<PlaceIndex> place_index;  ///< of VLAD; networks' descriptors are compared one by one
  std::vector<bool> is_certain;           ///< landmarks whose largest sigma is small enough

  State(std::shared_ptr<const KeyframeMap> used_map, const RelocalizerOptions& used_options)
      : map(checked(std::move(used_map), used_options)), options(used_options), extractor(map->feature_options) {
    if (FeatureModel network = map->place_network; !network.file.empty()) {
      place_network.emplace(network);
      if (place_network->size() != map->place_descriptors.rows())
        throw std::runtime_error(network.file + ": describes places by " + std::to_string(place_network->size()) +
                                 " numbers, the map by " + std::to_string(map->place_descriptors.rows()));
    } else {
      place_index.emplace(map->place_descriptors);
    }
    for (const Landmark& landmark : map->landmarks)
      is_certain.push_back(largestSigma(landmark.covariance) <= options.max_point_sigma);
  }

  const Keyframe& keyframe(int index) const { return map->keyframes[static_cast<std::size_t>(index)]; }

  /// The problem's reference camera of a keyframe, added if it is new.
  int referenceCamera(int keyframe_index, RelocalizationResult& result) const {
    const auto known = std::find(result.keyframes.begin(), result.keyframes.end(), keyframe_index);
    if (known == result.keyframes.end()) {
      result.keyframes.push_back(keyframe_index);
      result.problem.reference_cameras.push_back(map->referenceCamera(keyframe(keyframe_index)));
      return static_cast<int>(result.keyframes.size()) - 1;
    }
    return static_cast<int>(known - result.keyframes.begin());
  }

  bool isNear(const Eigen::Vector3d& point_in_map, const Keyframe& reference) const {
    return (point_in_map - map->referenceCamera(reference).map_from_camera.translation()).norm() <=
           options.reliable_depth;
  }

  /// With the landmark as point if its depth is reliable.
  MatchCandidate candidate(Match match, const Keyframe& reference, int landmark, bool is_dense, float ratio) const {
    if (landmark >= 0 && is_certain[static_cast<std::size_t>(landmark)]) {
      const Landmark& seen = map->landmarks[static_cast<std::size_t>(landmark)];
      if (isNear(seen.point_in_map, reference)) match.point = MapPoint{seen.point_in_map, seen.covariance};
    }
    return {std::move(match), is_dense, ratio, landmark};
  }

  void addSparse(const FeatureSet& query, const Keyframe& reference, Match match,
                 std::vector<MatchCandidate>& all) const {
    const FeatureSet& features = reference.features;
    for (const FeatureMatch& found : matchFeatures(query, features, options.matching)) {
      match.query_pixel = query.pixels[static_cast<std::size_t>(found.query)].cast<double>();
      match.reference_pixel = features.pixels[static_cast<std::size_t>(found.reference)].cast<double>();
      const int landmark = reference.landmark_of_feature[static_cast<std::size_t>(found.reference)];
      match.inlier_odds = inlierOdds(found.ratio, map->feature_options.kind);
      all.push_back(candidate(match, reference, landmark, false, found.ratio));
    }
  }

  void addDense(const DenseMatcher& matcher, const QueryImage& query, const Keyframe& reference, Match match,
                std::vector<MatchCandidate>& all) const {
    for (const DenseCorrespondence& found : denseCorrespondences(matcher, query.calibration, *map, reference)) {
      match.query_pixel = found.query_pixel;
      match.reference_pixel = found.reference_pixel;
      all.push_back(candidate(match, reference, found.landmark, true, 1));
    }
  }

  void addDepth(const Keyframe& reference, std::span<MatchCandidate> candidates) const {
    constexpr double max_interpolated_sigma = 0.5;  // m; between landmarks the scene may be anything
    const double max_sigma = std::min(max_interpolated_sigma, options.max_point_sigma);
    const ReferenceDepth depth(*map, reference, is_certain);
    for (MatchCandidate& candidate : candidates) {
      if (candidate.match.point) continue;
      const auto point = depth.at(candidate.match.reference_pixel);
      if (point && isNear(point->point_in_map, reference) && largestSigma(point->covariance) <= max_sigma)
        candidate.match.point = point;
    }
  }

  void addImage(const QueryImage& image, RelocalizationResult& result) const {
    const int query_camera = static_cast<int>(result.problem.query_cameras.size());
    result.problem.query_cameras.push_back({image.calibration.pinhole, image.robot_from_camera});
    Stopwatch stopwatch;
    const FeatureSet query = extractor.extract(image.image, image.calibration, image.mask);
    stopwatch.addTo(result.times.features);
    if (query.size() == 0) return;
    const Eigen::VectorXf place =
        place_network ? place_network->describe(image.image, image.mask) : map->vocabulary.describe(query);
    const int count = std::max(options.retrieved, options.ranked);
    const std::vector<RetrievedPlace> places =
        place_network ? retrieve(map->place_descriptors, place, count) : place_index->retrieve(place, count);
    stopwatch.addTo(result.times.retrieval);
    const auto dense_matcher = options.setting == MatchSetting::scsd ? nullptr : gridMatcher(image.image, image.mask);
    std::vector<MatchCandidate> all;
    for (const int index : bestMatched(places, query, *map, options)) {
      const Keyframe& reference = keyframe(index);
      Match match;
      match.query_camera = query_camera;
      match.reference_camera = referenceCamera(index, result);
      const std::size_t first = all.size();
      addSparse(query, reference, match, all);
      if (dense_matcher) addDense(*dense_matcher, image, reference, match, all);
      if (options.setting == MatchSetting::dcdd) addDepth(reference, std::span(all).subspan(first));
    }
    for (MatchCandidate& candidate : withoutRepetition(std::move(all)))
      result.problem.matches.push_back(std::move(candidate.match));
    stopwatch.addTo(result.times.matching);
  }
};

Relocalizer::Relocalizer(std::shared_ptr<const KeyframeMap> map, const RelocalizerOptions& options)
    : state_(std::make_unique<State>(std::move(map), options)) {}

Relocalizer::~Relocalizer() = default;

const KeyframeMap& Relocalizer::map() const { return *state_->map; }
const RelocalizerOptions& Relocalizer::options() const { return state_->options; }

RelocalizationResult Relocalizer::match(std::span<const QueryImage> images) const {
  RelocalizationResult result;
  for (const QueryImage& image : images) state_->addImage(image, result);
  return result;
}

RelocalizationResult Relocalizer::relocalize(std::span<const QueryImage> images) const {
  RelocalizationResult result = match(images);
  Stopwatch stopwatch;
  result.estimate = estimatePose(result, map(), state_->options);
  stopwatch.addTo(result.times.estimation);
  return result;
}

}  // namespace vmcl

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
#include "expected_view.h"
#include "inlier_odds.h"
#include "largest_sigma.h"
#include "match_candidate.h"
#include "place_ranking.h"
#include "reference_depth.h"
#include "vmcl/relocalization/solution_choice.h"
#include "vmcl/vision/guided_matching.h"
#include "vmcl/vision/match_network.h"
#include "vmcl/vision/place_index.h"
#include "vmcl/vision/place_network.h"

namespace vmcl {
namespace {

constexpr double least_odds = 1e-3;  // that a match may have

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
  std::optional<MatchNetwork> match_network;
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
    if (!options.dense_network.empty()) match_network.emplace(options.dense_network);
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

  void addSparse(std::span<const FeatureMatch> matches, const FeatureSet& query, const Keyframe& reference, Match match,
                 std::vector<MatchCandidate>& all) const {
    for (const FeatureMatch& found : matches) {
      match.query_pixel = query.pixels[static_cast<std::size_t>(found.query)].cast<double>();
      match.reference_pixel = reference.features.pixels[static_cast<std::size_t>(found.reference)].cast<double>();
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

  FeatureSet featuresOf(const QueryImage& image, RelocalizationTimes& times) const {
    Stopwatch stopwatch;
    FeatureSet features = extractor.extract(image.image, image.calibration, image.mask);
    stopwatch.addTo(times.features);
    return features;
  }

  /// Most alike or best matched.
  std::vector<int> keyframesFor(const QueryImage& image, const FeatureSet& query, Stopwatch& stopwatch,
                                RelocalizationTimes& times) const {
    const Eigen::VectorXf place =
        place_network ? place_network->describe(image.image, image.mask) : map->vocabulary.describe(query);
    const int count = std::max(options.retrieved, options.ranked);
    const std::vector<RetrievedPlace> places =
        place_network ? retrieve(map->place_descriptors, place, count) : place_index->retrieve(place, count);
    stopwatch.addTo(times.retrieval);
    return bestMatched(places, query, *map, options);
  }

  void addImage(const QueryImage& image, const FeatureSet& query, RelocalizationResult& result) const {
    const int query_camera = addQueryCamera(image, result.problem);
    if (query.size() == 0) return;
    Stopwatch stopwatch;
    const std::vector<int> keyframes = keyframesFor(image, query, stopwatch, result.times);
    const auto dense_matcher = denseMatcher(image);
    std::vector<MatchCandidate> all;
    for (const int index : keyframes) {
      const Keyframe& reference = keyframe(index);
      Match match;
      match.query_camera = query_camera;
      match.reference_camera = referenceCamera(index, result);
      const std::size_t first = all.size();
      addSparse(matchFeatures(query, reference.features, options.matching), query, reference, match, all);
      if (dense_matcher) addDense(*dense_matcher, image, reference, match, all);
      if (options.setting == MatchSetting::dcdd) addDepth(reference, std::span(all).subspan(first));
    }
    addMatches(std::move(all), result.problem);
    stopwatch.addTo(result.times.matching);
  }

  /// Null for matches of features alone.
  std::unique_ptr<DenseMatcher> denseMatcher(const QueryImage& image) const {
    if (options.setting == MatchSetting::scsd) return nullptr;
    return match_network ? match_network->matcher(image.image, image.mask) : gridMatcher(image.image, image.mask);
  }

  /// Returns how much more evidence than by uniform outliers the matches need, as a log.
  double addExpectedImage(const QueryImage& image, const FeatureSet& query, const ExpectedPose& expected,
                          RelocalizationResult& result) const {
    const int query_camera = addQueryCamera(image, result.problem);
    Stopwatch stopwatch;
    const ExpectedView view(*map, image, expected, options);
    std::vector<MatchCandidate> all;
    for (const int index : view.keyframes()) {
      const Keyframe& reference = keyframe(index);
      Match match;
      match.query_camera = query_camera;
      match.reference_camera = referenceCamera(index, result);
      const std::vector<FeatureMatch> matches =
          matchExpected(query, reference.features, view.features(reference, is_certain), options.matching);
      const std::size_t first = all.size();
      addSparse(matches, query, reference, match, all);
      for (std::size_t i = 0; i < matches.size(); ++i)
        all[first + i].searched = view.shareOfImage(matches[i].searched_px2);
    }
    const double needed = addMatches(std::move(all), result.problem);
    stopwatch.addTo(result.times.matching);
    return needed;
  }

  void estimate(RelocalizationResult& result, double needed = 0) const {
    Stopwatch stopwatch;
    RelocalizerOptions demanding = options;
    demanding.estimator.in_sight_log_odds -= needed;
    result.estimate = estimatePose(result, *map, demanding);
    stopwatch.addTo(result.times.estimation);
  }

  static int addQueryCamera(const QueryImage& image, PoseProblem& problem) {
    problem.query_cameras.push_back({image.calibration.pinhole, image.robot_from_camera});
    return static_cast<int>(problem.query_cameras.size()) - 1;
  }

  /// An outlier lies in the area that was searched: in a smaller one it is likelier to agree by chance. Odds that are
  /// smaller by as much say so of one that agrees with a pose, and for all other matches too little against the pose;
  /// returns this difference as a log.
  double addMatches(std::vector<MatchCandidate> candidates, PoseProblem& problem) const {
    const double prior = options.estimator.likelihood.inlier_prior;
    double difference = 0;
    for (MatchCandidate& candidate : withoutRepetition(std::move(candidates))) {
      double& odds = candidate.match.inlier_odds;
      const double smaller = std::max(odds * candidate.searched, least_odds);
      difference += std::log1p(prior / (1 - prior) * odds) - std::log1p(prior / (1 - prior) * smaller);
      odds = smaller;
      problem.matches.push_back(std::move(candidate.match));
    }
    return difference;
  }
};

Relocalizer::Relocalizer(std::shared_ptr<const KeyframeMap> map, const RelocalizerOptions& options)
    : state_(std::make_unique<State>(std::move(map), options)) {}

Relocalizer::~Relocalizer() = default;

const KeyframeMap& Relocalizer::map() const { return *state_->map; }
const RelocalizerOptions& Relocalizer::options() const { return state_->options; }

RelocalizationResult Relocalizer::match(std::span<const QueryImage> images) const {
  RelocalizationResult result;
  for (const QueryImage& image : images) state_->addImage(image, state_->featuresOf(image, result.times), result);
  return result;
}

RelocalizationResult Relocalizer::match(std::span<const QueryImage> images, const ExpectedPose& expected) const {
  expected.check();
  if (state_->options.setting != MatchSetting::scsd) return match(images);
  RelocalizationResult near, anywhere;
  std::vector<FeatureSet> features;
  double needed = 0;
  for (const QueryImage& image : images) {
    features.push_back(state_->featuresOf(image, near.times));
    needed += state_->addExpectedImage(image, features.back(), expected, near);
  }
  state_->estimate(near, needed);
  if (near.estimate.found()) return near;
  anywhere.times = near.times;
  for (std::size_t i = 0; i < images.size(); ++i) state_->addImage(images[i], features[i], anywhere);
  return anywhere;
}

RelocalizationResult Relocalizer::relocalize(std::span<const QueryImage> images) const {
  RelocalizationResult result = match(images);
  state_->estimate(result);
  return result;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "reference_depth.h"
#include "vmcl/vision/dense_matching.h"

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

/// Dense matches nearer to each other than this share most of the windows that they were found by, and their errors.
constexpr double independent_px = 3 * dense_grid_step;

/// A match of one query image before evidence that repeats itself is dropped.
struct Candidate {
  Match match;
  bool is_dense = false;
  float ratio = 1;
  int landmark = -1;
};

/// Odds of a match by its ratio, over those of all: fitted to where the pixels of 255,000 SIFT matches between day and
/// evening fall in simulated rooms, at the true pose; 60 at most. It is all but the same in each; ORB's is a little
/// flatter. Of other kinds nothing is known.
double inlierOdds(float ratio, FeatureKind kind) {
  const bool is_known = kind == FeatureKind::sift || kind == FeatureKind::orb;
  return is_known ? std::exp(11 * (0.63 - std::max(double{ratio}, 0.26))) : 1;
}

double largestSigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

/// Each place of the query image was measured once and gives one match, with depth if there is such a one, by the most
/// distinctive feature: matches with several references, and features that differ in orientation alone, share its
/// error. So does a landmark, seen through whatever reference. Dense matches fill what is left of the image, one a
/// cell of independent_px, and bring depth to cells without.
std::vector<Candidate> withoutRepetition(std::vector<Candidate> candidates) {
  std::ranges::stable_sort(candidates, {}, [](const Candidate& candidate) {
    return std::tuple(candidate.is_dense, !candidate.match.point, candidate.ratio);
  });
  std::set<int> used_landmarks;
  std::set<std::pair<double, double>> used_places;
  std::set<std::pair<int, int>> cells, cells_with_depth;
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const Eigen::Vector2d& pixel = candidate.match.query_pixel;
    const Eigen::Vector2i cell = (pixel / independent_px).array().floor().cast<int>();
    const std::pair place(pixel.x(), pixel.y());
    const std::pair cell_place(cell.x(), cell.y());
    if (candidate.is_dense ? (candidate.match.point ? cells_with_depth : cells).contains(cell_place)
                           : used_places.contains(place))
      return true;
    if (candidate.landmark >= 0 && !used_landmarks.insert(candidate.landmark).second) return true;
    used_places.insert(place);
    cells.insert(cell_place);
    if (candidate.match.point) cells_with_depth.insert(cell_place);
    return false;
  });
  return candidates;
}

/// Nothing far outside the calibrated field, where the distortion has no inverse.
std::optional<Eigen::Vector2d> idealPixel(const CameraCalibration& calibration, const Eigen::Vector2f& distorted) {
  const Eigen::Vector2d ideal = calibration.undistort(distorted.cast<double>());
  if (!((calibration.distort(ideal) - distorted.cast<double>()).norm() < 0.1)) return std::nullopt;
  return ideal;
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

struct Relocalizer::State {
  std::shared_ptr<const KeyframeMap> map;
  RelocalizerOptions options;
  FeatureExtractor extractor;
  std::vector<bool> is_certain;  ///< landmarks whose largest sigma is small enough

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
  Candidate candidate(Match match, const Keyframe& reference, int landmark, bool is_dense, float ratio) const {
    if (landmark >= 0 && is_certain[static_cast<std::size_t>(landmark)]) {
      const Landmark& seen = map->landmarks[static_cast<std::size_t>(landmark)];
      if (isNear(seen.point_in_map, reference)) match.point = MapPoint{seen.point_in_map, seen.covariance};
    }
    return {std::move(match), is_dense, ratio, landmark};
  }

  void addSparse(const FeatureSet& query, const Keyframe& reference, Match match, std::vector<Candidate>& all) const {
    const FeatureSet& features = reference.features;
    for (const FeatureMatch& found : matchFeatures(query, features, options.matching)) {
      match.query_pixel = query.pixels[static_cast<std::size_t>(found.query)].cast<double>();
      match.reference_pixel = features.pixels[static_cast<std::size_t>(found.reference)].cast<double>();
      const int landmark = reference.landmark_of_feature[static_cast<std::size_t>(found.reference)];
      match.inlier_odds = inlierOdds(found.ratio, map->feature_options.kind);
      all.push_back(candidate(match, reference, landmark, false, found.ratio));
    }
  }

  /// Points on a grid and, for their depth, landmarks.
  void addDense(const DenseMatcher& matcher, const QueryImage& query, const Keyframe& reference, Match match,
                std::vector<Candidate>& all) const {
    const MapCamera& camera = map->cameras[static_cast<std::size_t>(reference.camera)];
    const PinholeCamera& pinhole = camera.calibration.pinhole;
    const Image image = decompressImage(reference.dense.image);
    if (image.width != pinhole.width || image.height != pinhole.height)
      throw std::runtime_error("the map's image at " + std::to_string(reference.time) + " s has another size");
    std::vector<Eigen::Vector2f> points = denseGrid(image.width, image.height, camera.mask_rows_from_top);
    std::vector<int> landmarks(points.size(), -1);
    for (std::size_t i = 0; i < reference.landmark_of_feature.size(); ++i) {
      if (reference.landmark_of_feature[i] < 0) continue;
      points.push_back(camera.calibration.distort(reference.features.pixels[i].cast<double>()).cast<float>());
      landmarks.push_back(reference.landmark_of_feature[i]);
    }
    for (const DenseMatch& found : matcher.match(image.view(), points)) {
      const auto query_pixel = idealPixel(query.calibration, found.query_pixel);
      const auto reference_pixel = idealPixel(camera.calibration, points[static_cast<std::size_t>(found.point)]);
      if (!query_pixel || !reference_pixel || isMasked(query, found.query_pixel)) continue;
      match.query_pixel = *query_pixel;
      match.reference_pixel = *reference_pixel;
      all.push_back(candidate(match, reference, landmarks[static_cast<std::size_t>(found.point)], true, 1));
    }
  }

  static bool isMasked(const QueryImage& query, const Eigen::Vector2f& pixel) {
    const Eigen::Vector2i at = pixel.array().round().cast<int>();
    if (at.y() < query.mask_rows_from_top) return true;
    const ImageView& mask = query.mask;
    return !mask.empty() && at.x() >= 0 && at.x() < mask.width && at.y() < mask.height &&
           mask.pixels[static_cast<std::size_t>(at.y()) * mask.row_bytes + static_cast<std::size_t>(at.x())] >= 128;
  }

  void addDepth(const Keyframe& reference, std::span<Candidate> candidates) const {
    const ReferenceDepth depth(*map, reference, is_certain);
    for (Candidate& candidate : candidates) {
      if (candidate.match.point) continue;
      const auto point = depth.at(candidate.match.reference_pixel);
      if (point && isNear(point->point_in_map, reference) && largestSigma(point->covariance) <= options.max_point_sigma)
        candidate.match.point = point;
    }
  }

  void addImage(const QueryImage& image, RelocalizationResult& result) const {
    const int query_camera = static_cast<int>(result.problem.query_cameras.size());
    result.problem.query_cameras.push_back({image.calibration.pinhole, image.robot_from_camera});
    Stopwatch stopwatch;
    const FeatureSet query = extractor.extract(image.image, image.calibration, image.mask, image.mask_rows_from_top);
    stopwatch.addTo(result.times.features);
    if (query.size() == 0) return;
    const std::vector<RetrievedPlace> places =
        retrieve(map->place_descriptors, map->vocabulary.describe(query), options.retrieved);
    stopwatch.addTo(result.times.retrieval);
    const auto dense_matcher =
        options.setting == MatchSetting::scsd ? nullptr : gridMatcher(image.image, image.mask_rows_from_top);
    std::vector<Candidate> all;
    for (const RetrievedPlace& place : places) {
      const Keyframe& reference = keyframe(place.index);
      Match match;
      match.query_camera = query_camera;
      match.reference_camera = referenceCamera(place.index, result);
      const std::size_t first = all.size();
      addSparse(query, reference, match, all);
      if (dense_matcher) addDense(*dense_matcher, image, reference, match, all);
      if (options.setting == MatchSetting::dcdd) addDepth(reference, std::span(all).subspan(first));
    }
    for (Candidate& candidate : withoutRepetition(std::move(all)))
      result.problem.matches.push_back(std::move(candidate.match));
    stopwatch.addTo(result.times.matching);
  }
};

Relocalizer::Relocalizer(std::shared_ptr<const KeyframeMap> map, const RelocalizerOptions& options)
    : state_([&] {
        options.check();
        if (map == nullptr || map->keyframes.empty() || map->vocabulary.empty())
          throw std::invalid_argument("the map is empty");
        map->check();
        if (options.setting != MatchSetting::scsd && !map->isDense())
          throw std::invalid_argument("the map is not dense, as " + std::string(nameOf(options.setting)) +
                                      " needs it: make it with --dense");
        return new State{map, options, FeatureExtractor(map->feature_options), {}};
      }()) {
  for (const Landmark& landmark : map->landmarks)
    state_->is_certain.push_back(largestSigma(landmark.covariance) <= options.max_point_sigma);
}

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
  result.estimate = estimatePose(result.problem, map(), state_->options.estimator);
  stopwatch.addTo(result.times.estimation);
  return result;
}

}  // namespace vmcl

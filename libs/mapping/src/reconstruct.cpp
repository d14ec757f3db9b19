// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct.h"

#include <algorithm>
#include <optional>
#include <set>

#include "keyframe_pairs.h"
#include "noise_estimate.h"
#include "pose_uncertainty.h"
#include "tracks.h"

namespace vmcl {
namespace {

constexpr int neighbours = 12;         // keyframes that each keyframe is matched with
constexpr double gate = 3.72;          // standard deviations that hold 99.9 % of a 2-D Gaussian
constexpr double nearest_scene = 0.3;  // m from a camera
constexpr double usual_depth = 2;      // m, to judge matches whose depth is not known yet
constexpr double usual_spread = 0.25;  // rad that the views of a track differ from their mean
/// Before the last, a round need not be exact: the next has other tracks.
struct Round {
  double share = 0;      ///< of the given uncertainty of poses and mounts, that is left
  double tolerance = 0;  ///< of the adjustment
};
constexpr Round rounds[] = {{1, 1e-3}, {0.2, 1e-3}, {0, 1e-4}};
constexpr double last_tolerance = 1e-6;

struct MatchedPair {
  int first = 0;
  int second = 0;
  std::vector<FeatureMatch> matches;  // query: first, reference: second
};

PoseUncertainty uncertainty(const MapBuilderOptions& options, double share) {
  return {.position = share * options.sigma_position,
          .heading = share * options.sigma_heading,
          .tilt = share * options.sigma_tilt,
          .mount_tilt = share * options.sigma_mount_tilt};
}

std::vector<ReferenceCamera> allViews(const Reconstruction& scene) {
  std::vector<ReferenceCamera> views;
  for (int k = 0; k < std::ssize(scene.keyframes); ++k) views.push_back(scene.view(k));
  return views;
}

std::vector<MatchedPair> matchPairs(const Reconstruction& scene, const MapBuilderOptions& options,
                                    const BuildProgress& progress) {
  std::vector<MatchedPair> pairs;
  const auto candidates = overlappingPairs(allViews(scene), neighbours);
  for (const auto& [first, second] : candidates) {
    progress("matching", static_cast<double>(pairs.size()) / static_cast<double>(candidates.size()));
    const FeatureSet& query = scene.keyframes[static_cast<std::size_t>(first)].features;
    const FeatureSet& reference = scene.keyframes[static_cast<std::size_t>(second)].features;
    pairs.push_back({first, second, matchFeatures(query, reference, options.matching)});
  }
  return pairs;
}

/// The matches that agree with the poses as far as these are known.
std::vector<ObservationMatch> consistentMatches(const Reconstruction& scene, std::span<const MatchedPair> pairs,
                                                const PoseUncertainty& poses, double sigma_px) {
  std::vector<ObservationMatch> consistent;
  for (const MatchedPair& pair : pairs) {
    const ReferenceCamera first = scene.view(pair.first), second = scene.view(pair.second);
    const Rigid3 second_from_first = second.map_from_camera.inverse() * first.map_from_camera;
    const double difference = viewDifference(first.map_from_camera, second.map_from_camera);
    const double sigma_each =
        std::hypot(sigma_px / std::min(first.camera.fx, second.camera.fx), poses.ofDirection(usual_depth, difference));
    for (const FeatureMatch& match : pair.matches) {
      const Observation seen_first{pair.first, match.query}, seen_second{pair.second, match.reference};
      const double distance = epipolarArcDistance(first.camera.ray(scene.idealPixel(seen_first)).normalized(),
                                                  second.camera.ray(scene.idealPixel(seen_second)).normalized(),
                                                  second_from_first, nearest_scene);
      if (distance < gate * std::sqrt(2) * sigma_each) consistent.push_back({seen_first, seen_second, match.ratio});
    }
  }
  return consistent;
}

/// How far an observation lies from where the point should be seen, in standard deviations.
double deviation(const Sighting& sighting, const Eigen::Vector3d& point_in_map, const PoseUncertainty& poses,
                 const MeasurementNoise& noise) {
  const double z = (sighting.view.map_from_camera.inverse() * point_in_map).z();
  const double direction = poses.ofDirection(std::max(nearest_scene, z), usual_spread);
  const double of_pixel =
      reprojectionError(sighting, point_in_map) / std::hypot(noise.pixel, sighting.view.camera.fx * direction);
  if (!(sighting.depth > 0)) return of_pixel;
  const double of_depth = std::abs(1 / z - 1 / sighting.depth) /
                          std::hypot(noise.inverse_depth, poses.position / (sighting.depth * sighting.depth));
  return z > 0 ? std::max(of_pixel, of_depth) : of_pixel;
}

/// Whether there are enough observations to tell a wrong one.
bool isSupported(std::span<const Sighting> seen) {
  return std::ssize(seen) >= min_observations ||
         (seen.size() >= 2 && std::ranges::any_of(seen, [](const Sighting& sighting) { return sighting.depth > 0; }));
}

/// Triangulates the track, leaving out one after the other the observation that fits worst; counts what becomes of it.
std::optional<ScenePoint> placeTrack(const Reconstruction& scene, Track track, const PoseUncertainty& poses,
                                     const MeasurementNoise& noise, TrackCounts& counts) {
  for (auto seen = sightings(scene, track); isSupported(seen);) {
    const auto [point, failure] = triangulate(seen, noise);
    if (failure != TriangulationFailure::none) {
      ++(failure == TriangulationFailure::behind_a_view ? counts.behind : counts.parallax);
      return std::nullopt;
    }
    std::vector<double> deviations;
    for (const Sighting& sighting : seen) deviations.push_back(deviation(sighting, point.point_in_map, poses, noise));
    const auto worst = std::ranges::max_element(deviations) - deviations.begin();
    if (deviations[static_cast<std::size_t>(worst)] < gate) {
      if (isWellPlaced(point, seen)) return ScenePoint{point.point_in_map, std::move(track)};
      ++counts.parallax;
      return std::nullopt;
    }
    track.erase(track.begin() + worst);
    seen.erase(seen.begin() + worst);
  }
  ++counts.reprojection;
  return std::nullopt;
}

void placeTracks(Reconstruction& scene, std::vector<Track> tracks, const PoseUncertainty& poses,
                 const MeasurementNoise& noise, TrackCounts& counts) {
  scene.points.clear();
  for (Track& track : tracks)
    if (auto point = placeTrack(scene, std::move(track), poses, noise, counts))
      scene.points.push_back(std::move(*point));
}

/// Points of the features with a measured depth that no track has. They move no pose, so that no adjustment needs them.
void addPointsSeenOnce(Reconstruction& scene, const MeasurementNoise& noise, TrackCounts& counts) {
  std::set<std::pair<int, int>> tracked;
  for (const ScenePoint& point : scene.points)
    for (const Observation& seen : point.track) tracked.emplace(seen.keyframe, seen.feature);
  for (int k = 0; k < std::ssize(scene.keyframes); ++k)
    for (int i = 0; i < scene.keyframes[static_cast<std::size_t>(k)].features.size(); ++i) {
      if (!(scene.depth({k, i}) > 0) || tracked.contains({k, i})) continue;
      const Track once = {{k, i}};
      const auto seen = sightings(scene, once);
      const auto [point, failure] = triangulate(seen, noise);
      if (failure != TriangulationFailure::none || !isWellPlaced(point, seen)) continue;
      scene.points.push_back({point.point_in_map, once});
      ++counts.seen_once;
    }
}

std::vector<Track> tracksOf(std::vector<ScenePoint> points) {
  std::vector<Track> tracks;
  for (ScenePoint& point : points) tracks.push_back(std::move(point.track));
  return tracks;
}

/// How far the poses have moved from those given: root of the mean square, in the standard deviations that these have.
double poseDeviation(const Reconstruction& scene, const MapBuilderOptions& options) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < scene.keyframes.size(); ++k) {
    const PlanarPose moved = inverse(planarPart(scene.keyframes[k].map_from_robot)) * scene.map_from_robot[k];
    if (options.sigma_position > 0) {
      sum += (moved.x * moved.x + moved.y * moved.y) / (options.sigma_position * options.sigma_position);
      count += 2;
    }
    if (options.sigma_heading > 0) {
      sum += moved.phi * moved.phi / (options.sigma_heading * options.sigma_heading);
      count += 1;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

/// Moves the scene, and learns what errors the measurements have, by themselves and together.
void adjustAndJudge(Reconstruction& scene, ReconstructionResult& result, const MapBuilderOptions& options,
                    double tolerance) {
  AdjustmentNoise noise = result.noise;
  noise.position /= result.next_shared_error;
  noise.heading /= result.next_shared_error;
  adjust(scene, noise, tolerance);
  result.noise.measurement = estimatedNoise(scene, noise.measurement);
  result.shared_error = result.next_shared_error;
  result.next_shared_error = std::max(1.0, result.shared_error * poseDeviation(scene, options));
}

AdjustmentNoise firstNoise(const MapBuilderOptions& options) {
  return {.measurement = {.pixel = options.sigma_px},
          .position = options.sigma_position,
          .heading = options.sigma_heading,
          .tilt = options.sigma_tilt,
          .height = options.sigma_height,
          .mount_rotation = options.sigma_mount_tilt,
          .mount_shift = options.sigma_mount_shift,
          .focal = options.sigma_focal,
          .radial = options.sigma_radial};
}

std::vector<int> featureCounts(const Reconstruction& scene) {
  std::vector<int> counts;
  for (const Keyframe& keyframe : scene.keyframes) counts.push_back(keyframe.features.size());
  return counts;
}

}  // namespace

ReconstructionResult reconstruct(Reconstruction& scene, const MapBuilderOptions& options,
                                 const BuildProgress& progress) {
  const std::vector<MatchedPair> pairs = matchPairs(scene, options, progress);
  ReconstructionResult result{firstNoise(options), {}};
  const MeasurementNoise& noise = result.noise.measurement;
  const bool has_depth = std::ranges::any_of(scene.depths, [](const auto& depths) { return !depths.empty(); });
  const int min_track_length = has_depth ? 2 : min_observations;
  double done = 0;
  for (const auto& [share, tolerance] : rounds) {
    progress("adjusting", done++ / std::ssize(rounds));
    const PoseUncertainty poses = uncertainty(options, share);
    std::vector<Track> tracks =
        joinTracks(featureCounts(scene), consistentMatches(scene, pairs, poses, noise.pixel), min_track_length);
    result.tracks = {.seen = static_cast<int>(tracks.size())};
    placeTracks(scene, std::move(tracks), poses, noise, result.tracks);
    adjustAndJudge(scene, result, options, tolerance);
  }
  placeTracks(scene, tracksOf(std::move(scene.points)), {}, noise, result.tracks);
  adjustAndJudge(scene, result, options, last_tolerance);
  addPointsSeenOnce(scene, noise, result.tracks);
  return result;
}

std::vector<Sighting> sightings(const Reconstruction& scene, const Track& track) {
  std::vector<Sighting> seen;
  for (const Observation& observation : track)
    seen.push_back({scene.view(observation.keyframe), scene.idealPixel(observation), scene.depth(observation)});
  return seen;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "map_assembly.h"

#include <algorithm>

#include "landmark_covariance.h"

namespace vmcl {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

void addLandmarks(KeyframeMap& map, const Reconstruction& scene, ReconstructionResult& result) {
  const std::vector<Eigen::Matrix3d> covariances = pointCovariances(scene, result.noise);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const ScenePoint& point = scene.points[i];
    if (!isWellPlaced({point.point_in_map, covariances[i]}, sightings(scene, point.track))) {
      point.track.size() > 1 ? ++result.tracks.covariance : --result.tracks.seen_once;
      continue;
    }
    for (const Observation& seen : point.track)
      map.keyframes[static_cast<std::size_t>(seen.keyframe)]
          .landmark_of_feature[static_cast<std::size_t>(seen.feature)] = static_cast<int>(map.landmarks.size());
    map.landmarks.push_back({point.point_in_map, covariances[i], static_cast<int>(point.track.size())});
  }
}

/// Of the keyframes' poses as adjusted against as given, in the robot frame. The priors count as one keyframe more,
/// which keeps few keyframes from looking exact.
Eigen::Matrix3d poseCovariance(const Reconstruction& scene, const MapBuilderOptions& options) {
  const Eigen::Vector3d prior(options.sigma_position, options.sigma_position, options.sigma_heading);
  Eigen::Matrix3d sum = prior.cwiseAbs2().asDiagonal();
  for (std::size_t k = 0; k < scene.keyframes.size(); ++k) {
    const PlanarPose off = inverse(planarPart(scene.keyframes[k].map_from_robot)) * scene.map_from_robot[k];
    const Eigen::Vector3d error(off.x, off.y, off.phi);
    sum += error * error.transpose();
  }
  return sum / static_cast<double>(scene.keyframes.size());
}

void addPlaces(KeyframeMap& map, const Reconstruction& scene, const MapBuilderOptions& options) {
  map.place_network = options.place_network;
  if (!scene.places.empty()) {
    map.place_descriptors.resize(scene.places.front().size(), std::ssize(scene.places));
    for (Eigen::Index i = 0; i < map.place_descriptors.cols(); ++i)
      map.place_descriptors.col(i) = scene.places[static_cast<std::size_t>(i)];
    return;
  }
  std::vector<const FeatureSet*> sets;
  for (const Keyframe& keyframe : map.keyframes) sets.push_back(&keyframe.features);
  map.vocabulary = VladVocabulary::train(sets, options.words, options.seed);
  map.place_descriptors.resize(map.vocabulary.words().size(), std::ssize(sets));
  for (Eigen::Index i = 0; i < map.place_descriptors.cols(); ++i)
    map.place_descriptors.col(i) = map.vocabulary.describe(*sets[static_cast<std::size_t>(i)]);
}

/// Features are kept as ideal pixels of the corrected cameras. Where the corrected distortion has no inverse, far off
/// the axis, no landmark is seen and the pixel stays.
void correctPixels(KeyframeMap& map, const Reconstruction& scene) {
  for (int k = 0; k < std::ssize(map.keyframes); ++k) {
    Keyframe& keyframe = map.keyframes[static_cast<std::size_t>(k)];
    const CameraCalibration& calibration = map.cameras[static_cast<std::size_t>(keyframe.camera)].calibration;
    for (int i = 0; i < keyframe.features.size(); ++i) {
      const Eigen::Vector2d distorted = scene.distortedPixel({k, i}), ideal = calibration.undistort(distorted);
      if ((calibration.distort(ideal) - distorted).norm() < 0.1)
        keyframe.features.pixels[static_cast<std::size_t>(i)] = ideal.cast<float>();
    }
  }
}

}  // namespace

KeyframeMap assembleMap(const Reconstruction& scene, ReconstructionResult& result, const MapBuilderOptions& options) {
  KeyframeMap map;
  map.feature_options = options.features;
  map.cameras = scene.cameras;
  for (int i = 0; i < std::ssize(map.cameras); ++i) {
    MapCamera& camera = map.cameras[static_cast<std::size_t>(i)];
    camera.calibration = scene.calibration(i);
    camera.robot_from_camera = scene.robotFromCamera(i);
  }
  map.keyframes = scene.keyframes;
  for (int k = 0; k < std::ssize(map.keyframes); ++k)
    map.keyframes[static_cast<std::size_t>(k)].map_from_robot = scene.pose(k);
  correctPixels(map, scene);
  addLandmarks(map, scene, result);
  map.pose_covariance = poseCovariance(scene, options);
  addPlaces(map, scene, options);
  map.check();
  return map;
}

MapBuildReport reportOf(const KeyframeMap& map, const Reconstruction& scene, const ReconstructionResult& result) {
  MapBuildReport report;
  report.keyframes = static_cast<int>(map.keyframes.size());
  for (const Keyframe& keyframe : map.keyframes) report.features += keyframe.features.size();
  report.landmarks = static_cast<int>(map.landmarks.size());
  report.tracks = result.tracks;
  for (const Landmark& landmark : map.landmarks)
    if (landmark.observation_count > 1) report.mean_observations += landmark.observation_count;
  report.mean_observations /= std::max(1, report.landmarks - result.tracks.seen_once);
  report.shared_error = result.shared_error;
  report.sigma_px = result.noise.measurement.pixel;
  if (std::ranges::any_of(map.cameras, [](const MapCamera& camera) { return camera.depth != DepthSource::none; }))
    report.sigma_depth = result.noise.measurement.inverse_depth;
  std::vector<double> errors;
  for (const ScenePoint& point : scene.points)
    if (point.track.size() > 1)
      for (const Sighting& seen : sightings(scene, point.track))
        errors.push_back(reprojectionError(seen, point.point_in_map));
  report.median_reprojection_px = median(std::move(errors));
  for (const CameraCorrection& correction : scene.corrections) {
    report.mount_correction.push_back(correction.rotation);
    report.mount_shift.push_back(correction.shift);
    report.focal_scale.push_back(1 + correction.lens[0]);
  }
  return report;
}

}  // namespace vmcl

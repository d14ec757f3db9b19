// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_builder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "feature_check.h"
#include "landmark_covariance.h"
#include "reconstruct.h"

namespace vmcl {
namespace {

void require(bool holds, const char* key, double value) {
  if (!holds) throw std::invalid_argument(std::string(key) + " is " + std::to_string(value));
}

bool isAtLeast(double value, double bound) { return std::isfinite(value) && value >= bound; }

}  // namespace

void MapBuilderOptions::check() const {
  features.check();
  matching.check();
  require(isAtLeast(keyframe_distance, 0), "keyframe_distance", keyframe_distance);
  require(isAtLeast(keyframe_rotation, 0), "keyframe_rotation", keyframe_rotation);
  require(isAtLeast(sigma_px, 1e-3), "sigma_px", sigma_px);
  require(isAtLeast(sigma_position, 0), "sigma_position", sigma_position);
  require(isAtLeast(sigma_heading, 0), "sigma_heading", sigma_heading);
  require(isAtLeast(sigma_mount_tilt, 0), "sigma_mount_tilt", sigma_mount_tilt);
  require(isAtLeast(sigma_mount_shift, 0), "sigma_mount_shift", sigma_mount_shift);
  require(isAtLeast(sigma_focal, 0), "sigma_focal", sigma_focal);
  require(isAtLeast(sigma_radial, 0), "sigma_radial", sigma_radial);
  require(words >= 1, "words", words);
}

struct MapBuilder::State {
  MapBuilderOptions options;
  std::vector<FeatureExtractor> extractors;              // per camera
  std::vector<std::optional<PlanarPose>> last_keyframe;  // per camera
  std::vector<MapCamera> cameras;
  std::vector<Keyframe> keyframes;
  int session = 0;
  int frames = 0;

  bool hasMoved(int camera, const PlanarPose& map_from_robot) const {
    const auto& last = last_keyframe[static_cast<std::size_t>(camera)];
    if (!last) return true;
    const PlanarPose last_from_robot = inverse(*last) * map_from_robot;
    return std::hypot(last_from_robot.x, last_from_robot.y) >= options.keyframe_distance ||
           std::abs(last_from_robot.phi) >= options.keyframe_rotation;
  }

  void keep(double time, int camera, const PlanarPose& map_from_robot, FeatureSet features) {
    const std::vector<int> no_landmarks(features.pixels.size(), -1);
    keyframes.push_back({time, camera, session, toRigid3(map_from_robot), std::move(features), no_landmarks});
    last_keyframe[static_cast<std::size_t>(camera)] = map_from_robot;
  }

  /// The pose on the ground of a frame worth keeping; nothing for one too near the last keyframe.
  std::optional<PlanarPose> offer(double time, int camera, const Rigid3& map_from_robot) {
    if (!std::isfinite(time)) throw std::invalid_argument("image time is not finite");
    if (camera < 0 || camera >= std::ssize(cameras))
      throw std::invalid_argument("no camera " + std::to_string(camera) + " in the map");
    const PlanarPose pose = planarPart(map_from_robot);
    if (!isFinite(pose)) throw std::invalid_argument("robot pose is not finite");
    ++frames;
    if (!hasMoved(camera, pose)) return std::nullopt;
    return pose;
  }
};

MapBuilder::MapBuilder(std::vector<MapCamera> cameras, const MapBuilderOptions& options)
    : state_(std::make_unique<State>()) {
  options.check();
  state_->options = options;
  for (MapCamera& camera : cameras) addCamera(std::move(camera));
}

MapBuilder::~MapBuilder() = default;
MapBuilder::MapBuilder(MapBuilder&&) noexcept = default;

int MapBuilder::addCamera(MapCamera camera) {
  FeatureOptions features = state_->options.features;
  camera.mask_rows_from_top = std::max(camera.mask_rows_from_top, features.mask_rows_from_top);
  features.mask_rows_from_top = camera.mask_rows_from_top;
  KeyframeMap of_camera;
  of_camera.feature_options = features;
  of_camera.cameras = {camera};
  of_camera.check();
  state_->extractors.emplace_back(features);
  state_->options.features.model = state_->extractors.back().options().model;  // with its checksum
  state_->cameras.push_back(std::move(camera));
  state_->last_keyframe.emplace_back();
  return static_cast<int>(state_->cameras.size()) - 1;
}

bool MapBuilder::add(double time, int camera, const Rigid3& map_from_robot, const ImageView& image) {
  const auto pose = state_->offer(time, camera, map_from_robot);
  if (!pose) return false;
  const auto i = static_cast<std::size_t>(camera);
  const MapCamera& taken_by = state_->cameras[i];
  state_->keep(time, camera, *pose, state_->extractors[i].extract(image, taken_by.calibration, taken_by.mask.view()));
  if (state_->options.dense) state_->keyframes.back().dense.image = compressImage(image);
  return true;
}

bool MapBuilder::add(double time, int camera, const Rigid3& map_from_robot, FeatureSet features) {
  checkFeatures(features, state_->options.features.kind, "image at " + std::to_string(time));
  const auto pose = state_->offer(time, camera, map_from_robot);
  if (!pose) return false;
  state_->keep(time, camera, *pose, std::move(features));
  return true;
}

int MapBuilder::keyframeCount() const { return static_cast<int>(state_->keyframes.size()); }

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Enters the points whose marginal covariance is sane as landmarks of the map.
void addLandmarks(KeyframeMap& map, const Reconstruction& scene, const MapBuilderOptions& options) {
  const std::vector<Eigen::Matrix3d> covariances = pointCovariances(scene, adjustmentNoise(options));
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const ScenePoint& point = scene.points[i];
    if (!isWellPlaced({point.point_in_map, covariances[i]}, sightings(scene, point.track))) continue;
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

void addPlaces(KeyframeMap& map, const MapBuilderOptions& options) {
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

MapBuildReport report(const KeyframeMap& map, const Reconstruction& scene, int frames) {
  MapBuildReport report;
  report.frames = frames;
  report.keyframes = static_cast<int>(map.keyframes.size());
  for (const Keyframe& keyframe : map.keyframes) report.features += keyframe.features.size();
  report.landmarks = static_cast<int>(map.landmarks.size());
  for (const Landmark& landmark : map.landmarks) report.mean_observations += landmark.observation_count;
  report.mean_observations /= std::max(1, report.landmarks);
  std::vector<double> errors;
  for (const ScenePoint& point : scene.points)
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

}  // namespace

std::pair<KeyframeMap, MapBuildReport> MapBuilder::build(const BuildProgress& progress) {
  if (state_->keyframes.empty()) throw std::runtime_error("no keyframes to build a map of");
  const MapBuilderOptions& options = state_->options;
  const BuildProgress report_progress = progress ? progress : [](std::string_view, double) {};
  Reconstruction scene;
  scene.cameras = state_->cameras;
  scene.corrections.resize(scene.cameras.size());
  scene.keyframes = std::exchange(state_->keyframes, {});
  for (const Keyframe& keyframe : scene.keyframes) scene.map_from_robot.push_back(planarPart(keyframe.map_from_robot));
  if (std::ranges::all_of(scene.keyframes, [](const Keyframe& keyframe) { return keyframe.features.size() == 0; }))
    throw std::runtime_error("no features in any image: blank or covered by the mask");
  reconstruct(scene, options, report_progress);

  report_progress("describing places", 0);
  KeyframeMap map;
  map.feature_options = options.features;
  map.cameras = scene.cameras;
  for (int i = 0; i < std::ssize(map.cameras); ++i) {
    MapCamera& camera = map.cameras[static_cast<std::size_t>(i)];
    camera.calibration = scene.calibration(i);
    camera.robot_from_camera = scene.robotFromCamera(i);
  }
  map.keyframes = scene.keyframes;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k)
    map.keyframes[k].map_from_robot = toRigid3(scene.map_from_robot[k]);
  correctPixels(map, scene);
  addLandmarks(map, scene, options);
  map.pose_covariance = poseCovariance(scene, options);
  addPlaces(map, options);
  report_progress("describing places", 1);
  map.check();
  MapBuildReport built = report(map, scene, state_->frames);
  return {std::move(map), std::move(built)};
}

}  // namespace vmcl

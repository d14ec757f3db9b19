// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_builder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "feature_check.h"
#include "map_assembly.h"
#include "reconstruct.h"
#include "vmcl/vision/place_network.h"

namespace vmcl {
namespace {

void require(bool holds, const char* key, double value) {
  if (!holds) throw std::invalid_argument(std::string(key) + " is " + std::to_string(value));
}

bool isAtLeast(double value, double bound) { return std::isfinite(value) && value >= bound; }

/// As DenseView keeps it.
std::vector<uint16_t> sparserDepth(const DepthImage& depth) {
  std::vector<uint16_t> millimetres;
  for (int row = 0; row < depth.height; row += DenseView::depth_step)
    for (int column = 0; column < depth.width; column += DenseView::depth_step) {
      const float value = 1000 * depth.depths[static_cast<std::size_t>(row * depth.width + column)];
      millimetres.push_back(value >= 0 && value < 65535 ? static_cast<uint16_t>(std::lround(value)) : 0);
    }
  return millimetres;
}

void checkDepth(const DepthImage& depth, const PinholeCamera& camera) {
  if (depth.empty()) return;
  if (depth.width != camera.width || depth.height != camera.height ||
      std::ssize(depth.depths) != std::ptrdiff_t{camera.width} * camera.height)
    throw std::invalid_argument("the depth image is " + std::to_string(depth.width) + " x " +
                                std::to_string(depth.height) + " pixels, its camera " + std::to_string(camera.width) +
                                " x " + std::to_string(camera.height));
}

}  // namespace

void MapBuilderOptions::check() const {
  features.check();
  matching.check();
  require(isAtLeast(keyframe_distance, 0), "keyframe_distance", keyframe_distance);
  require(isAtLeast(keyframe_rotation, 0), "keyframe_rotation", keyframe_rotation);
  require(isAtLeast(sigma_px, 1e-3), "sigma_px", sigma_px);
  require(isAtLeast(sigma_position, 0), "sigma_position", sigma_position);
  require(isAtLeast(sigma_heading, 0), "sigma_heading", sigma_heading);
  require(isAtLeast(sigma_tilt, 0), "sigma_tilt", sigma_tilt);
  require(isAtLeast(sigma_height, 0), "sigma_height", sigma_height);
  require(isAtLeast(sigma_mount_tilt, 0), "sigma_mount_tilt", sigma_mount_tilt);
  require(isAtLeast(sigma_mount_shift, 0), "sigma_mount_shift", sigma_mount_shift);
  require(isAtLeast(sigma_focal, 0), "sigma_focal", sigma_focal);
  require(isAtLeast(sigma_radial, 0), "sigma_radial", sigma_radial);
  require(words >= 1, "words", words);
}

struct MapBuilder::State {
  MapBuilderOptions options;
  std::vector<FeatureExtractor> extractors;          // per camera
  std::vector<std::optional<Rigid3>> last_keyframe;  // per camera
  std::vector<MapCamera> cameras;
  std::vector<Keyframe> keyframes;
  std::vector<std::vector<float>> depths;  // as in Reconstruction
  std::optional<PlaceNetwork> place_network;
  std::vector<Eigen::VectorXf> places;  // as in Reconstruction
  int session = 0;

  bool hasMoved(int camera, const Rigid3& map_from_robot) const {
    const auto& last = last_keyframe[static_cast<std::size_t>(camera)];
    if (!last) return true;
    const Rigid3 last_from_robot = last->inverse() * map_from_robot;
    return last_from_robot.translation().norm() >= options.keyframe_distance ||
           Eigen::AngleAxisd(last_from_robot.linear()).angle() >= options.keyframe_rotation;
  }

  void keep(double time, int camera, const Rigid3& map_from_robot, FeatureSet features, std::vector<float> measured) {
    const std::vector<int> no_landmarks(features.pixels.size(), -1);
    keyframes.push_back({time, camera, session, map_from_robot, std::move(features), no_landmarks});
    if (std::ranges::none_of(measured, [](float depth) { return depth > 0; })) measured.clear();
    if (DepthSource& source = cameras[static_cast<std::size_t>(camera)].depth;
        !measured.empty() && source == DepthSource::none)
      source = DepthSource::range;
    depths.push_back(std::move(measured));
    last_keyframe[static_cast<std::size_t>(camera)] = map_from_robot;
  }

  /// The pose of a frame worth keeping; nothing for one too near the last keyframe.
  std::optional<Rigid3> offer(double time, int camera, const Rigid3& map_from_robot) const {
    if (!std::isfinite(time)) throw std::invalid_argument("image time is not finite");
    if (camera < 0 || camera >= std::ssize(cameras))
      throw std::invalid_argument("no camera " + std::to_string(camera) + " in the map");
    if (!map_from_robot.matrix().allFinite()) throw std::invalid_argument("robot pose is not finite");
    const Rigid3 pose = options.flat ? toRigid3(planarPart(map_from_robot)) : map_from_robot;
    if (!hasMoved(camera, pose)) return std::nullopt;
    return pose;
  }
};

MapBuilder::MapBuilder(std::vector<MapCamera> cameras, const MapBuilderOptions& options)
    : state_(std::make_unique<State>()) {
  options.check();
  state_->options = options;
  if (FeatureModel& network = state_->options.place_network; !network.file.empty())
    state_->place_network.emplace(network);
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

void MapBuilder::startSession() {
  if (!state_->keyframes.empty()) ++state_->session;
  for (auto& last : state_->last_keyframe) last.reset();
}

bool MapBuilder::add(double time, int camera, const Rigid3& map_from_robot, const ImageView& image,
                     const DepthImage& depth) {
  const auto pose = state_->offer(time, camera, map_from_robot);
  if (!pose) return false;
  const auto i = static_cast<std::size_t>(camera);
  const MapCamera& taken_by = state_->cameras[i];
  checkDepth(depth, taken_by.calibration.pinhole);
  FeatureSet features = state_->extractors[i].extract(image, taken_by.calibration, taken_by.imageMask());
  std::vector<float> depths;
  if (!depth.empty())
    for (const Eigen::Vector2f& pixel : features.pixels)
      depths.push_back(depthAt(depth, taken_by.calibration.distort(pixel.cast<double>())));
  if (state_->place_network) state_->places.push_back(state_->place_network->describe(image, taken_by.imageMask()));
  state_->keep(time, camera, *pose, std::move(features), std::move(depths));
  if (state_->options.dense) state_->keyframes.back().dense = {compressImage(image), sparserDepth(depth)};
  return true;
}

bool MapBuilder::add(double time, int camera, const Rigid3& map_from_robot, FeatureSet features,
                     std::vector<float> depths) {
  const std::string name = "image at " + std::to_string(time);
  if (state_->place_network) throw std::invalid_argument(name + ": no image for " + state_->options.place_network.file);
  checkFeatures(features, state_->options.features.kind, name);
  if (!depths.empty() && depths.size() != features.pixels.size())
    throw std::invalid_argument(name + ": not one depth a feature");
  if (!std::ranges::all_of(depths, [](float depth) { return depth >= 0 && std::isfinite(depth); }))
    throw std::invalid_argument(name + ": a depth is negative or not finite");
  const auto pose = state_->offer(time, camera, map_from_robot);
  if (!pose) return false;
  state_->keep(time, camera, *pose, std::move(features), std::move(depths));
  return true;
}

bool MapBuilder::isNewKeyframe(double time, int camera, const Rigid3& map_from_robot) const {
  return state_->offer(time, camera, map_from_robot).has_value();
}

int MapBuilder::keyframeCount() const { return static_cast<int>(state_->keyframes.size()); }

std::pair<KeyframeMap, MapBuildReport> MapBuilder::build(const BuildProgress& progress) {
  if (state_->keyframes.empty()) throw std::runtime_error("no keyframes to build a map of");
  const MapBuilderOptions& options = state_->options;
  const BuildProgress report_progress = progress ? progress : [](std::string_view, double) {};
  Reconstruction scene;
  scene.cameras = state_->cameras;
  scene.corrections.resize(scene.cameras.size());
  scene.keyframes = std::exchange(state_->keyframes, {});
  scene.stance.assign(scene.keyframes.size(), Eigen::Vector3d::Zero());
  scene.depths = std::exchange(state_->depths, {});
  scene.places = std::exchange(state_->places, {});
  for (const Keyframe& keyframe : scene.keyframes) {
    scene.map_from_robot.push_back(planarPart(keyframe.map_from_robot));
    scene.level_from_robot.push_back(toRigid3(scene.map_from_robot.back()).inverse() * keyframe.map_from_robot);
  }
  if (std::ranges::all_of(scene.keyframes, [](const Keyframe& keyframe) { return keyframe.features.size() == 0; }))
    throw std::runtime_error("no features in any image: blank or covered by the mask");
  ReconstructionResult result = reconstruct(scene, options, report_progress);

  report_progress("describing places", 0);
  KeyframeMap map = assembleMap(scene, result, options);
  report_progress("describing places", 1);
  MapBuildReport built = reportOf(map, scene, result);
  return {std::move(map), std::move(built)};
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/visual_keyframe_map.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>

#include "in_parallel.h"
#include "vmcl/mapping/map_builder.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/image_measurements.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

struct InsertedImage {
  CameraObservation observation;
  Rigid3 map_from_robot;
};

KeyframeMap build(const std::vector<InsertedImage>& images, const MapBuilderOptions& options) {
  MapBuilder builder({}, options);
  std::map<std::string, int> cameras;
  for (const auto& [seen, map_from_robot] : images) {
    const auto [camera, is_new] = cameras.try_emplace(seen.label);
    if (is_new) camera->second = builder.addCamera({seen.label, seen.calibration, seen.robot_from_camera, 0});
    builder.add(seen.time, camera->second, map_from_robot, seen.image.view());
  }
  return builder.build().first;
}

}  // namespace

/// What is made when it is first asked for, and copied without.
struct VisualKeyframeMap::State {
  std::mutex mutex;
  std::vector<InsertedImage> inserted;
  std::shared_ptr<const KeyframeMap> content;
  std::shared_ptr<ImageMeasurements> measurements;

  std::string failure;  ///< why no map can be built of the inserted images

  std::set<std::string> told;

  /// With the mutex held. Throws std::runtime_error, each time the same, when the map cannot be built.
  const std::shared_ptr<const KeyframeMap>& built(const VisualMapOptions& options) {
    if (content || inserted.empty()) return content;
    if (failure.empty()) try {
        content = std::make_shared<const KeyframeMap>(build(inserted, options.builder));
      } catch (const std::exception& error) {
        failure = errorMessage(error);
      }
    if (!failure.empty()) throw std::runtime_error(failure);
    return content;
  }

  /// With the mutex held. Throws std::runtime_error for an image that does not go with those before.
  void insert(CameraObservation&& seen, const Rigid3& map_from_robot) {
    const auto before = std::find_if(inserted.begin(), inserted.end(),
                                     [&](const InsertedImage& image) { return image.observation.label == seen.label; });
    if (before != inserted.end() && !sameCalibration(before->observation.calibration, seen.calibration))
      throw std::runtime_error("camera '" + seen.label + "': other intrinsics than in its first image");
    inserted.push_back({std::move(seen), map_from_robot});
    content.reset();
    measurements.reset();
    failure.clear();
  }

  /// For callbacks of MRPT, where an exception would end the program. Each problem is told once.
  void tell(const std::string& problem) {
    const std::scoped_lock lock(mutex);
    if (told.insert(problem).second) std::cerr << "vmcl: visual map: " << problem << '\n';
  }

  /// Null when the map is empty.
  std::shared_ptr<ImageMeasurements> ready(const VisualMapOptions& options) {
    const std::scoped_lock lock(mutex);
    if (!built(options)) return nullptr;
    if (!measurements) measurements = std::make_shared<ImageMeasurements>(content, options);
    return measurements;
  }

  /// Null when the map is empty.
  std::shared_ptr<const ImageMeasurement> measurement(const mrpt::obs::CObservation& observation,
                                                      const VisualMapOptions& options,
                                                      const PoseWithCovariance* expected = nullptr) {
    const auto of_images = ready(options);
    return of_images ? of_images->of(observation, expected) : nullptr;
  }
};

VisualKeyframeMap::VisualKeyframeMap() : state_(std::make_unique<State>()) {}

VisualKeyframeMap::VisualKeyframeMap(const VisualMapOptions& options)
    : VisualKeyframeMap(options, options.map_file.empty()
                                     ? nullptr
                                     : std::make_shared<const KeyframeMap>(loadMap(options.map_file))) {}

VisualKeyframeMap::VisualKeyframeMap(const VisualMapOptions& options, std::shared_ptr<const KeyframeMap> content)
    : options_(options), state_(std::make_unique<State>()) {
  options_.check();
  state_->content = std::move(content);
}

VisualKeyframeMap::~VisualKeyframeMap() = default;

VisualKeyframeMap::VisualKeyframeMap(const VisualKeyframeMap& other) : VisualKeyframeMap() { *this = other; }

VisualKeyframeMap& VisualKeyframeMap::operator=(const VisualKeyframeMap& other) {
  if (this == &other) return *this;
  auto copy = std::make_unique<State>();
  {
    const std::scoped_lock lock(other.state_->mutex);
    copy->inserted = other.state_->inserted;
    copy->content = other.state_->content;
  }
  CMetricMap::operator=(other);
  options_ = other.options_;
  state_ = std::move(copy);
  return *this;
}

std::shared_ptr<const KeyframeMap> VisualKeyframeMap::content() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->built(options_);
}

bool VisualKeyframeMap::prepare() const { return state_->ready(options_) != nullptr; }

std::shared_ptr<const KeyframeMap> VisualKeyframeMap::contentOrReport() const try {
  return content();
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
  return nullptr;
}

void VisualKeyframeMap::internal_clear() {
  if (!options_.map_file.empty()) return;
  state_ = std::make_unique<State>();
}

bool VisualKeyframeMap::isEmpty() const {
  const std::scoped_lock lock(state_->mutex);
  return !state_->content && state_->inserted.empty();
}

bool VisualKeyframeMap::internal_insertObservation(const mrpt::obs::CObservation& observation,
                                                   const std::optional<const mrpt::poses::CPose3D>& robot_in_map) try {
  if (!options_.map_file.empty()) return false;
  auto camera = cameraObservation(observation);
  if (!camera) return false;
  const std::scoped_lock lock(state_->mutex);
  if (state_->content && state_->inserted.empty())
    throw std::runtime_error("no image can be inserted, as the content was given: clear it first");
  state_->insert(std::move(*camera), toRigid3(robot_in_map.value_or(mrpt::poses::CPose3D())));
  return true;
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
  return false;
}

bool VisualKeyframeMap::internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& observation) const {
  return holdsCameraImage(observation);
}

double VisualKeyframeMap::internal_computeObservationLikelihood(const mrpt::obs::CObservation& observation,
                                                                const mrpt::poses::CPose3D& robot_in_map) const try {
  if (!internal_canComputeObservationLikelihood(observation)) return 0;
  const auto measurement = state_->measurement(observation, options_);
  if (!measurement) return 0;
  if (!measurement->error.empty()) state_->tell(measurement->error);
  return measurement->logLikelihood({robot_in_map.x(), robot_in_map.y(), robot_in_map.yaw()});
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
  return 0;
}

double VisualKeyframeMap::addLogLikelihoods(const mrpt::obs::CObservation& observation,
                                            std::span<const PlanarPose> robot_in_map, int threads,
                                            std::span<double> log_likelihoods) const try {
  const auto measurement = state_->measurement(observation, options_);
  if (!measurement || !measurement->likelihood) return 0;
  std::vector<double> values(robot_in_map.size());
  const auto weigh = [&](std::size_t first, std::size_t size) {
    measurement->addLogLikelihoods(robot_in_map.subspan(first, size), std::span(values).subspan(first, size));
  };
  const std::size_t made = std::min<std::size_t>(1, values.size());  // what the first pose makes serves all
  weigh(0, made);
  inParallel(static_cast<std::size_t>(threads), values.size() - made,
             [&](std::size_t first, std::size_t size) { weigh(made + first, size); });
  std::transform(values.begin(), values.end(), log_likelihoods.begin(), log_likelihoods.begin(), std::plus<>());
  return measurement->independent_matches;
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
  return 0;
}

PoseEstimate VisualKeyframeMap::relocalize(const mrpt::obs::CObservation& observation, uint64_t seed) const {
  const auto measurement = state_->measurement(observation, options_);
  if (measurement && !measurement->error.empty()) throw std::runtime_error(measurement->error);
  if (!measurement || !measurement->likelihood) {
    PoseEstimate nothing;
    nothing.failure = NoPose::too_few_matches;
    nothing.reason = "no matches";
    return nothing;
  }
  EstimatorOptions options = options_.relocalizer.estimator;
  options.seed = seed;
  return estimatePose(measurement->problem, *content(), options);
}

void VisualKeyframeMap::expect(const mrpt::obs::CObservation& observation, const PoseWithCovariance& robot) const try {
  state_->measurement(observation, options_, &robot);
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
}

std::shared_ptr<const ImageMeasurement> VisualKeyframeMap::latestMeasurement() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->measurements ? state_->measurements->latest() : nullptr;
}

void VisualKeyframeMap::extend(PoseBox& box) const {
  constexpr double margin = 2;  // m about the keyframes
  const auto map = contentOrReport();
  if (!map) return;
  for (const Keyframe& keyframe : map->keyframes) {
    const Eigen::Vector3d position = keyframe.map_from_robot.translation();
    box.min_x = std::min(box.min_x, position.x() - margin);
    box.max_x = std::max(box.max_x, position.x() + margin);
    box.min_y = std::min(box.min_y, position.y() - margin);
    box.max_y = std::max(box.max_y, position.y() + margin);
  }
}

std::string VisualKeyframeMap::asString() const {
  const auto map = contentOrReport();
  return "VisualKeyframeMap: " + std::to_string(map ? map->keyframes.size() : 0) + " keyframes, " +
         std::to_string(map ? map->landmarks.size() : 0) + " landmarks";
}

void VisualKeyframeMap::saveMetricMapRepresentationToFile(const std::string& prefix) const try {
  if (const auto map = contentOrReport()) saveMap(prefix + ".vmap", *map);
} catch (const std::exception& error) {
  state_->tell(errorMessage(error));
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localizer.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/pose_conversion.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {
namespace {

using mrpt::maps::CMultiMetricMap;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;
using mrpt::poses::CPosePDFGaussian;

constexpr double max_movement = 1e3;  // m between two readings: more is no movement but a fault

bool isPlausible(const PlanarPose& movement) {
  return isFinite(movement) && std::hypot(movement.x, movement.y) <= max_movement;
}

PoseRegion startRegion(const LocalizationConfig& config, const CMultiMetricMap& maps) {
  if (!config.start_in_free_space) return PoseRegion(config.start);
  const auto grid = maps.mapByClass<COccupancyGridMap2D>();
  if (!grid) throw std::invalid_argument("init_PDF_mode = 0 needs a grid map ([MetricMap] occupancyGrid_count = 1)");
  return {config.start, *grid};
}

/// Where a lost robot may be: the free space of the grid map, or the starting box together with the visual maps.
PoseRegion anywhere(const LocalizationConfig& config, const CMultiMetricMap& maps) {
  PoseBox box = config.start;
  box.min_phi = -std::numbers::pi;
  box.max_phi = std::numbers::pi;
  if (const auto grid = maps.mapByClass<COccupancyGridMap2D>(); grid && !grid->isEmpty()) {
    box.min_x = grid->getXMin();
    box.max_x = grid->getXMax();
    box.min_y = grid->getYMin();
    box.max_y = grid->getYMax();
    return {box, *grid};
  }
  for (const auto& map : maps.maps)
    if (const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get())) relocalizing->extend(box);
  return PoseRegion(box);
}

/// None: the action tells of no movement.
std::optional<CPosePDFGaussian> movementOf(const CActionCollection* action) {
  if (!action) return std::nullopt;
  CPosePDFGaussian movement;
  if (const auto planar = action->getBestMovementEstimation()) {
    movement.copyFrom(*planar->poseChange);
    return movement;
  }
  const auto spatial = action->getActionByClass<mrpt::obs::CActionRobotMovement3D>();
  if (!spatial) return std::nullopt;
  movement.copyFrom(spatial->poseChange);
  return movement;
}

}  // namespace

Localizer::Localizer(const LocalizationConfig& config, CMultiMetricMap::Ptr maps)
    : config_(config),
      maps_(std::move(maps)),
      filter_(maps_, config.kld, config.filter, config.monte_carlo, anywhere(config, *maps_)) {
  filter_.start(config.start_anywhere ? anywhere(config, *maps_) : startRegion(config, *maps_), config.particles_count);
}

std::vector<std::string> Localizer::takeProblems() { return std::exchange(problems_, {}); }

std::optional<LocalizationFrame> Localizer::step(const CActionCollection::Ptr& action, const CSensoryFrame::Ptr& frame,
                                                 const CObservation::Ptr& observation) {
  if (const auto reading = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation)) {
    addOdometry(*reading);
    return std::nullopt;
  }
  if (steps_++ < config_.rawlog_offset) return std::nullopt;
  if (frame) return update(isUsable(action.get()) ? action.get() : nullptr, *frame);
  if (!observation || !maps_->canComputeObservationLikelihood(*observation)) return std::nullopt;
  CSensoryFrame single;
  single.insert(observation);
  const CActionCollection motion = motionSinceLastUpdate();
  return update(&motion, single);
}

bool Localizer::isUsable(const CActionCollection* action) {
  const auto movement = movementOf(action);
  const bool boundless = !movement && action && action->getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!boundless && !movement) return true;
  if (movement && isPlausible(toPlanarPose(movement->mean)) && movement->cov.asEigen().allFinite()) return true;
  problems_.push_back("a movement that is not finite or of more than 1000 m");
  return false;
}

void Localizer::addOdometry(const mrpt::obs::CObservationOdometry& reading) {
  const std::string sensor = "odometry '" + reading.sensorLabel + "': ";
  const PlanarPose pose = toPlanarPose(reading.odometry);
  if (!isFinite(pose)) {
    problems_.push_back(sensor + "a reading that is not finite");
    return;
  }
  const PlanarPose increment = odometry_ ? inverse(*odometry_) * pose : PlanarPose();
  odometry_ = pose;
  if (isPlausible(increment))
    moved_ = moved_ * increment;
  else
    problems_.push_back(sensor + "a jump of more than 1000 m");
}

/// With the odometry readings so far; when there are none the robot may have moved by the model's least noise.
CActionCollection Localizer::motionSinceLastUpdate() {
  const PlanarPose moved = std::exchange(moved_, {});
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({moved.x, moved.y, moved.phi}, config_.motion_model);
  CActionCollection motion;
  motion.insert(movement);
  return motion;
}

CSensoryFrame Localizer::usable(const CSensoryFrame& frame, std::vector<PoseMode>& modes, int& inliers) {
  CSensoryFrame used;
  for (const auto& observation : frame) {
    if (!maps_->canComputeObservationLikelihood(*observation)) continue;
    if (config_.odometry_only) {
      used.insert(observation);
      continue;
    }
    try {
      std::vector<PoseMode> found;
      int found_inliers = 0;
      for (const auto& map : maps_->maps) {
        const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get());
        if (!relocalizing || !map->canComputeObservationLikelihood(*observation)) continue;
        const PoseEstimate estimate = relocalizing->relocalize(*observation, config_.monte_carlo.seed);
        found.insert(found.end(), estimate.modes.begin(), estimate.modes.end());
        if (estimate.found()) found_inliers += static_cast<int>(estimate.modes.front().inliers.size());
      }
      modes.insert(modes.end(), found.begin(), found.end());
      inliers += found_inliers;
      used.insert(observation);
    } catch (const std::exception& error) {
      problems_.push_back(errorMessage(error));
    }
  }
  return used;
}

/// One deceptive image can carry a whole cluster elsewhere: a robot that jumps is not localized.
void Localizer::countSteadyFrames(const PoseCluster& cluster) {
  const LocalizedRule& rule = config_.localized;
  const bool narrow = cluster.positionDeviation() <= rule.max_position_deviation &&
                      cluster.headingDeviation() <= rule.max_heading_deviation && cluster.share >= rule.min_share;
  const Eigen::Vector3d jump =
      expected_ ? difference(cluster.robot_in_map, *expected_) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const bool as_expected =
      jump.head<2>().norm() <= rule.max_position_deviation && std::abs(jump.z()) <= rule.max_heading_deviation;
  steady_frames_ = !narrow ? 0 : as_expected ? steady_frames_ + 1 : 1;
  expected_ = cluster.robot_in_map;
}

std::optional<LocalizationFrame> Localizer::update(const CActionCollection* action, const CSensoryFrame& frame) {
  const auto begin = std::chrono::steady_clock::now();
  LocalizationFrame result;
  std::vector<PoseMode> modes;
  const CSensoryFrame used = usable(frame, modes, result.inliers);
  const CActionCollection* const motion = started_ ? action : nullptr;
  if (const auto movement = movementOf(motion); expected_ && movement)
    expected_ = *expected_ * toPlanarPose(movement->mean);
  if (used.size() == 0) {
    filter_.update(motion, nullptr);
    return std::nullopt;
  }
  started_ = true;
  filter_.update(motion, config_.odometry_only ? nullptr : &used, modes);
  result.cluster = dominantCluster(filter_);
  countSteadyFrames(result.cluster);
  result.time = mrpt::Clock::toDouble((*used.begin())->timestamp);
  result.localized = steady_frames_ >= config_.localized.min_frames;
  result.effective_share = filter_.effectiveShare();
  result.particles = static_cast<int>(filter_.particlesCount());
  result.latency = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localizer.h"

#include <mrpt/core/Clock.h>

#include <chrono>
#include <stdexcept>

#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {
namespace {

using mrpt::maps::CMultiMetricMap;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

bool isFinite(const mrpt::poses::CPose2D& pose) { return isFinite(PlanarPose{pose.x(), pose.y(), pose.phi()}); }

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

PlanarPose meanMotion(const CActionCollection* action) {
  const auto movement = action ? action->getBestMovementEstimation() : nullptr;
  if (!movement) return {};
  const mrpt::poses::CPose2D mean = movement->poseChange->getMeanVal();
  return {mean.x(), mean.y(), mean.phi()};
}

}  // namespace

Localizer::Localizer(const LocalizationConfig& config, CMultiMetricMap::Ptr maps)
    : config_(config),
      maps_(std::move(maps)),
      filter_(maps_, config.kld, config.filter, config.monte_carlo, anywhere(config, *maps_)) {
  filter_.start(startRegion(config, *maps_), config.particles_count);
}

std::vector<std::string> Localizer::takeProblems() { return std::exchange(problems_, {}); }

std::optional<LocalizationFrame> Localizer::step(const CActionCollection::Ptr& action, const CSensoryFrame::Ptr& frame,
                                                 const CObservation::Ptr& observation) {
  if (const auto reading = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation)) {
    if (!isFinite(reading->odometry)) {
      problems_.push_back("odometry '" + reading->sensorLabel + "': a reading that is not finite");
      return std::nullopt;
    }
    odometry_ = reading->odometry;
    if (!odometry_applied_) odometry_applied_ = odometry_;
    return std::nullopt;
  }
  if (steps_++ < config_.rawlog_offset) return std::nullopt;
  if (frame) return update(hasFiniteMotion(action.get()) ? action.get() : nullptr, *frame);
  if (!observation || !maps_->canComputeObservationLikelihood(*observation)) return std::nullopt;
  CSensoryFrame single;
  single.insert(observation);
  const CActionCollection motion = motionSinceLastUpdate();
  return update(&motion, single);
}

bool Localizer::hasFiniteMotion(const CActionCollection* action) {
  const auto movement = action ? action->getBestMovementEstimation() : nullptr;
  if (!movement || isFinite(movement->poseChange->getMeanVal())) return true;
  problems_.push_back("a movement that is not finite");
  return false;
}

/// With the odometry readings so far; when there are none the robot may have moved by the model's least noise.
CActionCollection Localizer::motionSinceLastUpdate() {
  mrpt::poses::CPose2D increment;
  if (odometry_) increment = *odometry_ - *odometry_applied_;
  odometry_applied_ = odometry_;
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry(increment, config_.motion_model);
  CActionCollection motion;
  motion.insert(movement);
  return motion;
}

CSensoryFrame Localizer::usable(const CSensoryFrame& frame, std::vector<PoseMode>& modes, int& inliers) {
  CSensoryFrame used;
  for (const auto& observation : frame) {
    if (!maps_->canComputeObservationLikelihood(*observation)) continue;
    try {
      for (const auto& map : maps_->maps) {
        const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get());
        if (!relocalizing || !map->canComputeObservationLikelihood(*observation)) continue;
        const PoseEstimate estimate = relocalizing->relocalize(*observation);
        modes.insert(modes.end(), estimate.modes.begin(), estimate.modes.end());
        if (estimate.found()) inliers += static_cast<int>(estimate.modes.front().inliers.size());
      }
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
  if (expected_) expected_ = *expected_ * meanMotion(motion);
  if (used.size() == 0) {
    filter_.update(motion, nullptr);
    return std::nullopt;
  }
  started_ = true;
  filter_.update(motion, &used, modes);
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

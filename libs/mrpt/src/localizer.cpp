// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localizer.h"

#include <mrpt/core/Clock.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "map_region.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/movement.h"
#include "vmcl/mrpt/observation_verdict.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {

using mrpt::maps::CMultiMetricMap;
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

/// What of a frame the maps can use, and what its images say.
struct Localizer::Used {
  struct Observation {
    CObservation::Ptr observation;
    std::vector<PoseMode> modes;
  };
  CSensoryFrame frame;
  std::vector<Observation> observations;
  int inliers = 0;

  std::vector<PoseMode> modes() const {
    std::vector<PoseMode> all;
    for (const auto& one : observations) all.insert(all.end(), one.modes.begin(), one.modes.end());
    return all;
  }
};

Localizer::Localizer(const LocalizerOptions& options)
    : options_(options),
      maps_(CMultiMetricMap::Create()),
      anywhere_(PoseBox{}),
      filter_(maps_, options.kld, options.filter, options.monte_carlo, anywhere_),
      monitor_(options.health),
      random_(options.monte_carlo.seed, 2) {
  options_.check();
}

Localizer::Localizer(const LocalizationConfig& config, CMultiMetricMap::Ptr maps) : Localizer(config) {
  const PoseBox& box = config.start;
  const bool is_range = box.min_x < box.max_x || box.min_y < box.max_y;
  setMap(std::move(maps), is_range ? std::optional(box) : std::nullopt);
  steps_to_skip_ = config.rawlog_offset;
  if (config.initial_pose)
    setInitialPose(*config.initial_pose);
  else if (config.start_anywhere)
    globalLocalization();
  else
    filter_.start(startRegion(config, *maps_), options_.particles_count);
}

void Localizer::setMap(CMultiMetricMap::Ptr maps, const std::optional<PoseBox>& extent) {
  anywhere_ = regionOf(*maps, extent);
  maps_ = std::move(maps);
  filter_.setMap(maps_, anywhere_);
  monitor_.forgetContradictions();
  steady_frames_ = 0;
  expected_.reset();
  guided_updates_.clear();
}

void Localizer::restart() {
  monitor_.restart();
  pending_ = {};
  since_use_.clear();
  noise_is_pending_ = false;
  steady_frames_ = 0;
  expected_.reset();
  updated_at_.reset();
  seen_at_.reset();
  lost_at_.reset();
}

void Localizer::setInitialPose(const PoseWithCovariance& pose) {
  filter_.start(pose, options_.particles_count);
  restart();
  if (anywhere_.volume() > 0 && !anywhere_.covers(pose.robot_in_map))
    problems_.push_back("the initial pose is off the map: x " + std::to_string(pose.robot_in_map.x) + " m, y " +
                        std::to_string(pose.robot_in_map.y) + " m");
}

void Localizer::globalLocalization() {
  if (anywhere_.volume() == 0) throw std::logic_error("the map does not tell where the robot may be");
  filter_.start(anywhere_, options_.particles_count);
  restart();
}

std::vector<std::string> Localizer::takeProblems() { return std::exchange(problems_, {}); }

PoseWithCovariance Localizer::estimate() const {
  if (filter_.m_particles.empty()) throw std::logic_error("no start has been given");
  const PoseCluster cluster = dominantCluster(filter_);
  return {cluster.robot_in_map * pending_, cluster.covariance};
}

std::vector<PoseCluster> Localizer::clusters() const {
  if (filter_.m_particles.empty()) return {};
  std::vector<PoseCluster> all = poseClusters(filter_);
  for (PoseCluster& cluster : all) cluster.robot_in_map = cluster.robot_in_map * pending_;
  return all;
}

std::optional<LocalizationFrame> Localizer::processNew(const CSensoryFrame& observations) {
  if (observations.size() == 0) return std::nullopt;
  const double time = timeOf(observations);
  const bool has_stood = std::exchange(has_stood_, true);
  const CSensoryFrame due = dueOnes(observations, time);
  if (due.size() == 0) {
    if (has_stood && seen_at_) monitor_.rest(time - *seen_at_);
    seen_at_ = time;
    return std::nullopt;
  }
  try {
    if (const auto frame = update(due)) return frame;
  } catch (const std::exception& error) {
    leaveOut(error);
    update_requested_ = true;
  }
  noteSilence(time);
  return std::nullopt;
}

/// Of an observation without a time: that of the last one used.
double Localizer::timeOf(const CSensoryFrame& frame) const {
  const auto stamp = (*frame.begin())->timestamp;
  return stamp == INVALID_TIMESTAMP ? updated_at_.value_or(0) : mrpt::Clock::toDouble(stamp);
}

/// The particles move at the next update, with noise that depends on the whole way.
void Localizer::advance(const PlanarPose& movement) {
  if (!updated_at_) return;  // the start is where the first observation is taken
  noteMovement(movement);
  pending_ = pending_ * movement;
  noise_is_pending_ = true;
}

/// An action brings its own noise, unless the options have a motion model.
void Localizer::advance(const CActionCollection& action) {
  const auto movement = movementOf(&action);
  if (!updated_at_ || !movement) return;
  const PlanarPose mean = toPlanarPose(movement->mean);
  if (options_.monte_carlo.motion_model) return advance(mean);
  noteMovement(mean);
  filter_.update(&action, nullptr);
}

void Localizer::noteMovement(const PlanarPose& movement) {
  since_use_.add(movement);
  if (expected_) expected_ = *expected_ * movement;
  constexpr double still_position = 1e-3, still_heading = 0.1 * degree;
  has_stood_ =
      has_stood_ && std::hypot(movement.x, movement.y) < still_position && std::abs(movement.phi) < still_heading;
}

CSensoryFrame Localizer::dueOnes(const CSensoryFrame& frame, double time) const {
  if (!updated_at_ || update_requested_ || odometry_.hasStopped(time)) return frame;
  CSensoryFrame ones;
  for (const auto& observation : frame)
    if (since_use_.isOver(observation->sensorLabel, options_.update_min_d, options_.update_min_a))
      ones.insert(observation);
  return ones;
}

std::optional<LocalizationFrame> Localizer::update(const CSensoryFrame& observations) {
  const auto begin = std::chrono::steady_clock::now();
  const Used used = usable(observations);
  if (used.observations.empty()) return std::nullopt;
  const double time = timeOf(used.frame);
  allowForStoppedOdometry(time);
  updated_at_ = time;
  if (std::exchange(noise_is_pending_, false)) {
    const CActionCollection moved = actionOf(std::exchange(pending_, {}));
    filter_.update(&moved, nullptr);
  }
  if (!options_.odometry_only) filter_.update(nullptr, &used.frame, used.modes());
  seen_at_ = time;
  for (const auto& observation : used.frame) since_use_.use(observation->sensorLabel);
  update_requested_ = false;
  const PoseCluster cluster = dominantCluster(filter_);
  UpdateEvidence seen = evidence(used, cluster);
  countSteadyFrames(cluster, seen);
  monitor_.update(seen);
  LocalizationFrame result = report(time, cluster);
  result.inliers = used.inliers;
  recover(time);
  result.latency = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

LocalizationFrame Localizer::report(double time, const PoseCluster& cluster) {
  LocalizationFrame result;
  result.time = time;
  result.cluster = cluster;
  result.cluster.robot_in_map = result.cluster.robot_in_map * pending_;
  result.health = monitor_.health();
  result.localized = result.health.status == LocalizationStatus::tracking;
  result.effective_share = filter_.effectiveShare();
  result.particles = static_cast<int>(filter_.particlesCount());
  return result;
}

/// Those that a map can use and that come for the first time.
CSensoryFrame Localizer::newOnes(const CSensoryFrame& frame) {
  CSensoryFrame ones;
  for (const auto& observation : frame) {
    if (!maps_->canComputeObservationLikelihood(*observation)) continue;
    if (order_.isNew(*observation))
      ones.insert(observation);
    else
      problems_.push_back("sensor '" + observation->sensorLabel + "': an observation twice or out of order");
  }
  return ones;
}

/// Where images are looked at first: now and then nowhere, for what they show may be found elsewhere, too.
std::optional<PoseWithCovariance> Localizer::expectation(const std::string& camera) {
  int& in_a_row = guided_updates_[camera];
  const bool is_guided = monitor_.health().status == LocalizationStatus::tracking && in_a_row < options_.guided_updates;
  in_a_row = is_guided ? in_a_row + 1 : 0;
  return is_guided ? std::optional(estimate()) : std::nullopt;
}

Localizer::Used Localizer::usable(const CSensoryFrame& frame) {
  Used used;
  for (const auto& observation : frame) {
    try {
      Used::Observation one{observation, {}};
      int inliers = 0;
      for (const auto& map : maps_->maps) {
        const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get());
        if (options_.odometry_only || !relocalizing || !map->canComputeObservationLikelihood(*observation)) continue;
        if (const auto expected = expectation(observation->sensorLabel)) relocalizing->expect(*observation, *expected);
        const PoseEstimate estimate = relocalizing->relocalize(*observation, options_.monte_carlo.seed);
        one.modes.insert(one.modes.end(), estimate.modes.begin(), estimate.modes.end());
        if (estimate.found()) inliers += static_cast<int>(estimate.modes.front().inliers.size());
      }
      used.inliers += inliers;
      used.frame.insert(observation);
      used.observations.push_back(std::move(one));
    } catch (const std::exception& error) {
      problems_.push_back(errorMessage(error));
    }
  }
  return used;
}

UpdateEvidence Localizer::evidence(const Used& used, const PoseCluster& cluster) {
  UpdateEvidence evidence;
  evidence.time = timeOf(used.frame);
  evidence.blind_motion = odometry_stopped_;
  if (options_.odometry_only) return evidence;
  for (const auto& [observation, modes] : used.observations)
    for (const auto& map : maps_->maps) {
      try {
        if (!map->canComputeObservationLikelihood(*observation)) continue;
        const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get());
        evidence.count(relocalizing ? judgeImage(*relocalizing, *observation, modes, cluster.robot_in_map)
                                    : judgeByRank(*map, *observation, anywhere_, cluster.robot_in_map, random_));
      } catch (const std::exception& error) {
        leaveOut(error);
        evidence.count(Verdict::silent);
      }
    }
  return evidence;
}

}  // namespace vmcl

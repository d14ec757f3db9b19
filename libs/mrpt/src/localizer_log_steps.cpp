// SPDX-License-Identifier: BSD-3-Clause
// How a Localizer takes in what comes: pairs of movement and observations, steps of a log, odometry.
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionRobotMovement2D.h>

#include <algorithm>
#include <cmath>

#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/localizer.h"
#include "vmcl/mrpt/movement.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

namespace {

constexpr const char* bad_movement = "a movement without a pose, not finite or of more than 1000 m";

}  // namespace

std::optional<LocalizationFrame> Localizer::process(const CActionCollection* action,
                                                    const CSensoryFrame& observations) try {
  const CSensoryFrame ones = newOnes(observations);
  if (filter_.m_particles.empty()) return std::nullopt;
  if (action && isUsable(*action)) advance(*action);
  return processNew(ones);
} catch (const std::exception& error) {
  return leaveOut(error);
}

std::optional<LocalizationFrame> Localizer::process(const PlanarPose& movement, const CSensoryFrame& observations) try {
  const CSensoryFrame ones = newOnes(observations);
  if (filter_.m_particles.empty()) return std::nullopt;
  if (isPlausibleMovement(movement))
    advance(movement);
  else
    problems_.push_back(bad_movement);
  return processNew(ones);
} catch (const std::exception& error) {
  return leaveOut(error);
}

std::nullopt_t Localizer::leaveOut(const std::exception& error) {
  problems_.push_back(errorMessage(error));
  return std::nullopt;
}

std::optional<LocalizationFrame> Localizer::step(const CActionCollection::Ptr& action, const CSensoryFrame::Ptr& frame,
                                                 const CObservation::Ptr& observation) try {
  if (const auto reading = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation))
    return addOdometry(*reading);
  if (steps_to_skip_ > 0) {
    --steps_to_skip_;
    return std::nullopt;
  }
  if (frame) return process(action.get(), *frame);
  if (!observation) return std::nullopt;
  CSensoryFrame single;
  single.insert(observation);
  const CSensoryFrame one = newOnes(single);
  if (one.size() == 0 || filter_.m_particles.empty()) return std::nullopt;
  advance(odometry_.takeMovement());
  return processNew(one);
} catch (const std::exception& error) {
  return leaveOut(error);
}

bool Localizer::isUsable(const CActionCollection& action) {
  const auto movement = movementOf(&action);
  const bool boundless = !movement && action.getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!boundless && !movement) return true;
  if (movement && isPlausibleMovement(toPlanarPose(movement->mean)) && movement->cov.asEigen().allFinite()) return true;
  problems_.push_back(bad_movement);
  return false;
}

/// With the noise of the options' model.
CActionCollection Localizer::actionOf(const PlanarPose& movement) const {
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry({movement.x, movement.y, movement.phi}, options_.motion_model);
  CActionCollection actions;
  actions.insert(action);
  return actions;
}

std::optional<LocalizationFrame> Localizer::addOdometry(const mrpt::obs::CObservationOdometry& reading) {
  if (odometry_stopped_ && isFinite(toPlanarPose(reading.odometry))) {
    odometry_.interrupt();  // the updates have allowed for the way since the last reading
    odometry_stopped_ = false;
  }
  const std::string problem = odometry_.add(reading);
  if (!problem.empty()) problems_.push_back(problem);
  if (!seen_at_ || reading.timestamp == INVALID_TIMESTAMP) return std::nullopt;
  const double time = mrpt::Clock::toDouble(reading.timestamp);
  if (problem.empty()) seen_at_ = std::min(*seen_at_, time);  // later only when a clock was set back
  if (!noteSilence(time)) return std::nullopt;
  advance(odometry_.takeMovement());
  return report(time, dominantCluster(filter_));
}

/// A robot whose odometry has stopped may move at a walk.
void Localizer::allowForStoppedOdometry(double time) {
  constexpr double longest = 1;                   // s
  constexpr double speed = 0.5, turn_rate = 0.5;  // standard deviations, m/s, rad/s
  const bool stopped = odometry_.hasStopped(time);
  if (stopped && !odometry_stopped_) problems_.push_back("the odometry has stopped");
  odometry_stopped_ = stopped;
  if (!stopped || !updated_at_) return;
  const double known_until = std::max(*updated_at_, odometry_.lastTime().value_or(*updated_at_));
  const double elapsed = std::clamp(time - known_until, 0.0, longest);
  filter_.diffuse(speed * elapsed, turn_rate * elapsed);
}

}  // namespace vmcl

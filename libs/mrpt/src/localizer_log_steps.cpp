// SPDX-License-Identifier: BSD-3-Clause
// How a Localizer takes in the steps of a log, and movements.
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionRobotMovement2D.h>

#include <cmath>

#include "vmcl/mrpt/localizer.h"
#include "vmcl/mrpt/movement.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

std::optional<LocalizationFrame> Localizer::step(const CActionCollection::Ptr& action, const CSensoryFrame::Ptr& frame,
                                                 const CObservation::Ptr& observation) {
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
  if (one.size() == 0) return std::nullopt;
  const CActionCollection moved = actionOf(odometry_.takeMovement());
  return processNew(&moved, one);
}

bool Localizer::isUsable(const CActionCollection* action) {
  const auto movement = movementOf(action);
  const bool boundless = !movement && action && action->getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!boundless && !movement) return true;
  if (movement && isPlausibleMovement(toPlanarPose(movement->mean)) && movement->cov.asEigen().allFinite()) return true;
  problems_.push_back("a movement that is not finite or of more than 1000 m");
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
  if (const std::string problem = odometry_.add(reading); !problem.empty()) problems_.push_back(problem);
  const double time = mrpt::Clock::toDouble(reading.timestamp), silence = options_.health.degraded_after;
  const bool silent = updated_at_ && !options_.odometry_only && time > *updated_at_ + silence &&
                      time > monitor_.health().last.time + silence;
  if (!silent) return std::nullopt;
  const CActionCollection moved = actionOf(odometry_.takeMovement());
  advance(&moved);
  UpdateEvidence nothing = monitor_.health().last;
  nothing = {.time = time, .steady = nothing.steady, .scattered = nothing.scattered};
  monitor_.update(nothing);
  return report(time);
}

/// A robot whose odometry has stopped may move at a walk.
void Localizer::allowForStoppedOdometry(double time) {
  constexpr double patience = 0.5, longest = 1;   // s
  constexpr double speed = 0.5, turn_rate = 0.5;  // standard deviations, m/s, rad/s
  const bool stopped = odometry_.silentFor(time) > patience;
  if (stopped && !odometry_stopped_) problems_.push_back("the odometry has stopped");
  odometry_stopped_ = stopped;
  if (!stopped || !updated_at_) return;
  const double elapsed = std::clamp(time - *updated_at_, 0.0, longest);
  filter_.diffuse(speed * elapsed, turn_rate * elapsed);
}

}  // namespace vmcl

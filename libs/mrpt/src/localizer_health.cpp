// SPDX-License-Identifier: BSD-3-Clause
// What a Localizer makes of its updates, and of their absence: is it steady, is it lost.
#include <algorithm>
#include <cmath>

#include "vmcl/mrpt/localizer.h"

namespace vmcl {

/// One deceptive image can carry a whole cluster elsewhere: a robot that jumps is not localized.
void Localizer::countSteadyFrames(const PoseCluster& cluster, UpdateEvidence& evidence) {
  constexpr double scattered_deviation = 0.6, scattered_share = 0.5;  // m: of a cluster's radius of 1 m
  constexpr double other_position = 1, other_heading = 45 * degree;   // to another cluster
  const LocalizedRule& rule = options_.localized;
  const bool narrow = cluster.positionDeviation() <= rule.max_position_deviation &&
                      cluster.headingDeviation() <= rule.max_heading_deviation && cluster.share >= rule.min_share;
  const Eigen::Vector3d jump =
      expected_ ? difference(cluster.robot_in_map, *expected_) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const bool as_expected =
      jump.head<2>().norm() <= rule.max_position_deviation && std::abs(jump.z()) <= rule.max_heading_deviation;
  steady_frames_ = !narrow ? 0 : as_expected ? steady_frames_ + 1 : 1;
  expected_ = cluster.robot_in_map;
  evidence.steady = steady_frames_ >= rule.min_frames;
  evidence.jumped = narrow && (jump.head<2>().norm() > other_position || std::abs(jump.z()) > other_heading);
  evidence.scattered = cluster.positionDeviation() > scattered_deviation || cluster.share < scattered_share;
}

/// A robot that is lost is sought nearby first, then everywhere.
void Localizer::recover(double time) {
  constexpr double share = 0.5, nearby_first = 0.2;
  const double reset_after = options_.health.lost_reset_after;
  if (monitor_.health().status != LocalizationStatus::lost || reset_after == 0) {
    lost_at_.reset();
    return;
  }
  if (!lost_at_) scattered_nearby_ = false;
  lost_at_ = std::min(lost_at_.value_or(time), time);  // later only when a clock was set back
  if (time - *lost_at_ >= reset_after) {
    filter_.scatterAnywhere(share);
    lost_at_ = time;
  } else if (!scattered_nearby_ && time - *lost_at_ >= nearby_first * reset_after) {
    filter_.scatterNearby(share);
    scattered_nearby_ = true;
  }
}

/// Each time another degraded_after has passed without an observation that could be used; returns whether it has.
bool Localizer::noteSilence(double time) {
  if (!seen_at_ || options_.odometry_only || time <= *seen_at_ + options_.health.degraded_after) return false;
  const UpdateEvidence& last = monitor_.health().last;
  monitor_.update({.time = time, .steady = last.steady, .scattered = last.scattered});
  seen_at_ = time;
  return true;
}

}  // namespace vmcl

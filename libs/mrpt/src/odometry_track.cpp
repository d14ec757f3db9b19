// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/odometry_track.h"

#include <mrpt/core/Clock.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

constexpr double max_movement = 1e3;   // m
constexpr double max_speed = 20;       // m/s
constexpr double any_speed_up_to = 2;  // m
constexpr double clock_set_anew = 10;  // s

}  // namespace

bool isPlausibleMovement(const PlanarPose& movement) {
  return isFinite(movement) && std::hypot(movement.x, movement.y) <= max_movement;
}

std::string OdometryTrack::add(const mrpt::obs::CObservationOdometry& reading) {
  const std::string sensor = "odometry '" + reading.sensorLabel + "': ";
  const Reading now{mrpt::Clock::toDouble(reading.timestamp), toPlanarPose(reading.odometry)};
  if (!isFinite(now.pose)) return sensor + "a reading that is not finite";
  if (!reading_) {
    reading_ = now;
    return "";
  }
  const double elapsed = now.time - reading_->time;
  if (elapsed < 0 && elapsed > -clock_set_anew) return sensor + "a reading older than the one before";
  const PlanarPose increment = inverse(reading_->pose) * now.pose;
  reading_ = now;
  if (!isPlausibleMovement(increment)) return sensor + "a jump of more than 1000 m";
  const double distance = std::hypot(increment.x, increment.y);
  if (distance > any_speed_up_to && distance > max_speed * std::abs(elapsed)) {
    std::ostringstream problem;
    problem << sensor << "a jump of " << distance << " m in " << elapsed << " s";
    return problem.str();
  }
  moved_ = moved_ * increment;
  return "";
}

PlanarPose OdometryTrack::takeMovement() { return std::exchange(moved_, {}); }

}  // namespace vmcl

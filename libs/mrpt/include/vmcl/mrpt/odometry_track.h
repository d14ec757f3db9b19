// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationOdometry.h>

#include <optional>
#include <string>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Movements of up to 1 km are movements; more is a fault.
bool isPlausibleMovement(const PlanarPose& movement);

/// The movement of the robot from its odometry readings. Readings that are not finite, older than the one before (by up
/// to 10 s: more is a clock set anew), or over 2 m and 20 m/s away from it are left out.
class OdometryTrack {
 public:
  /// What is wrong with the reading; empty: nothing.
  std::string add(const mrpt::obs::CObservationOdometry& reading);

  /// The movement between the readings since it was last asked for.
  PlanarPose takeMovement();

  /// The next reading is no movement, as when the robot has been carried off.
  void interrupt() { reading_.reset(); }

  /// Of the last reading, s; nothing before the first and after an interruption.
  std::optional<double> lastTime() const { return reading_ ? std::optional(reading_->time) : std::nullopt; }

  /// Whether there have been readings, the last over 0.5 s before this time (s).
  bool hasStopped(double time) const {
    constexpr double patience = 0.5;
    return reading_ && time - reading_->time > patience;
  }

 private:
  struct Reading {
    double time;
    PlanarPose pose;
  };
  std::optional<Reading> reading_;
  PlanarPose moved_;
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "wheel_odometry.h"

#include <algorithm>
#include <cmath>

namespace vmcl {

/// What a slipping wheel counts too much on this way.
PlanarPose WheelOdometry::slip(double way) {
  constexpr double slip_ratio = 0.5;
  if (noise_.slips_per_m > 0 && random_.uniform() < noise_.slips_per_m * way) {
    slip_left_ = std::abs(noise_.slip * random_.normal());
    slip_side_ = random_.uniform() < 0.5 ? 1 : -1;
  }
  const double slipped = std::min(slip_left_, slip_ratio * way);
  slip_left_ -= slipped;
  return {slipped / 2, 0, slip_side_ * slipped / noise_.track_width};
}

PlanarPose WheelOdometry::read(const PlanarPose& map_from_robot) {
  if (started_) {
    PlanarPose motion = inverse(map_from_robot_) * map_from_robot;
    const double way = std::hypot(motion.x, motion.y), turn = std::abs(motion.phi);
    const double way_error = std::sqrt(noise_.alpha3 * way + noise_.alpha4 * turn) * random_.normal();
    const double turn_error = std::sqrt(noise_.alpha1 * turn + noise_.alpha2 * way) * random_.normal();
    motion.x += way_error;
    motion.phi = wrapAngle(motion.phi + turn_error);
    if (noise_.alpha5 > 0) motion.y += std::sqrt(noise_.alpha5 * way) * random_.normal();
    motion = motion * slip(way);
    odom_from_robot_ = odom_from_robot_ * motion;
  }
  started_ = true;
  map_from_robot_ = map_from_robot;
  return odom_from_robot_;
}

}  // namespace vmcl

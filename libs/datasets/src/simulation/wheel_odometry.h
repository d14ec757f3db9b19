// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// How odometry errs, after the alphas of AMCL (Thrun et al. 2005, 5.4), but with variances that grow with the way and
/// the turn themselves, so that they do not depend on how often odometry is read. Now and then a wheel slips: for a
/// while it turns by half as much again as the robot goes, and the odometry counts way that the robot does not go, and
/// a turn that it does not make.
struct OdometryNoise {
  double alpha1 = 0.002;     ///< variance of the heading per turn (rad^2/rad)
  double alpha2 = 0.0005;    ///< variance of the heading per way (rad^2/m)
  double alpha3 = 0.0005;    ///< variance of the way per way (m^2/m)
  double alpha4 = 0.0001;    ///< variance of the way per turn (m^2/rad)
  double alpha5 = 0;         ///< variance of the drift sideways per way (m^2/m)
  double slips_per_m = 0;    ///< how often a wheel slips
  double slip = 0.05;        ///< standard deviation of the way counted too much in one slip (m)
  double track_width = 0.3;  ///< between the wheels (m)
};

/// Wheel odometry of a robot whose true poses it is shown one after the other.
class WheelOdometry {
 public:
  WheelOdometry(const OdometryNoise& noise, Random random) : noise_(noise), random_(random) {}

  /// The next reading, odom_from_robot; the first is the identity.
  PlanarPose read(const PlanarPose& map_from_robot);

 private:
  PlanarPose slip(double way);

  OdometryNoise noise_;
  Random random_;
  double slip_left_ = 0;  ///< that the wheel will count too much in the slip under way, m
  int slip_side_ = 1;     ///< 1: it seems to turn left
  bool started_ = false;
  PlanarPose map_from_robot_;
  PlanarPose odom_from_robot_;
};

}  // namespace vmcl

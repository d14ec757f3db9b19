// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// AMCL's two models of how wheel odometry errs, under its names and with its defaults; alphas are variances per
/// squared metre or radian.
/// - differential: the movement is a turn, a way and a turn (Thrun, Burgard, Fox: Probabilistic Robotics, table 5.6,
///   with squares), where a robot that backs does not count as turning round:
///       var(turn) = alpha1 turn^2 + alpha2 way^2,   var(way) = alpha3 way^2 + alpha4 (turn1^2 + turn2^2)
/// - omnidirectional: the way may go in any direction, and err across it too:
///       var(way) = alpha3 way^2 + alpha1 turn^2,  var(across) = alpha5 way^2 + alpha1 turn^2,
///       var(turn) = alpha4 turn^2 + alpha2 way^2
struct OdometryMotionModel {
  enum class Drive { differential, omnidirectional };

  Drive drive = Drive::differential;
  double alpha1 = 0.2;  ///< of the rotation, from rotation
  double alpha2 = 0.2;  ///< of the rotation, from translation
  double alpha3 = 0.2;  ///< of the translation, from translation
  double alpha4 = 0.2;  ///< of the translation, from rotation
  double alpha5 = 0.2;  ///< omnidirectional only: across the translation, from translation

  /// Throws std::invalid_argument naming the bad key.
  void check() const;

  /// A movement as it may have been when the odometry says `movement`; both in the robot's frame before it.
  PlanarPose draw(const PlanarPose& movement, Random& random) const;
};

}  // namespace vmcl

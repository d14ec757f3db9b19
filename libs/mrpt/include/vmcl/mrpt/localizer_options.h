// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionRobotMovement2D.h>

#include "vmcl/mrpt/health.h"
#include "vmcl/mrpt/planar_monte_carlo.h"

namespace vmcl {

/// When the particles count as one known pose.
struct LocalizedRule {
  double max_position_deviation = 0.3;  ///< of the dominant cluster, m
  double max_heading_deviation = 0.17;  ///< of the dominant cluster, rad
  double min_share = 0.8;               ///< of all weight that the cluster holds, (0, 1]
  int min_frames = 3;                   ///< updates in a row for which all of this holds, and between which the
                                        ///< cluster moved as the odometry says, to within the same deviations

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// How a Localizer works. The defaults are those of MRPT's pf-localization; amcl() gives AMCL's.
struct LocalizerOptions {
  int particles_count = 0;  ///< at every start, at least 1
  double update_min_d =
      0;  ///< m: an observation is used once the robot has moved so far since its sensor was used last,
  double update_min_a = 0;     ///< or has turned so far, rad; 0 and 0: every one
  int guided_updates = 0;      ///< of a tracked robot, in a row, whose images are looked at where the particles expect
                               ///< them first; then all over the map once. 0: all over the map always
  bool odometry_only = false;  ///< the maps weigh nothing
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions motion_model;  ///< of odometry, unless monte_carlo has one
  PlanarMonteCarlo::KldOptions kld;
  PlanarMonteCarlo::ParticleFilterOptions filter;
  PlanarMonteCarloOptions monte_carlo;
  LocalizedRule localized;
  HealthOptions health;

  /// AMCL's defaults (of Navigation 2): differential drive with alphas 0.2, update_min_d 0.25 m, update_min_a 0.2,
  /// resampling at each update, 500 to 2000 particles, pf_err 0.05, pf_z 0.99, bins of 0.5 m and 10 deg.
  static LocalizerOptions amcl();

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

}  // namespace vmcl

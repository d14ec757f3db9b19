// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// An estimate of the robot's pose in the map at a time (s), and whether its maker stands by it.
struct TimedEstimate {
  double time = 0;
  bool localized = false;
  PlanarPose robot_in_map;
};

/// Error of one estimate against the ground truth interpolated at its time. Nothing is aligned: the map frame is given,
/// and to find the robot in it is the task.
struct PoseError {
  double time = 0;      ///< s
  double position = 0;  ///< distance on the ground, m
  double heading = 0;   ///< absolute angle, [0, pi] rad
};

/// What a sample of errors comes to; all 0 when the sample is empty.
struct ErrorStatistics {
  double rmse = 0;
  double median = 0;  ///< of an even number: the mean of the middle two
  double max = 0;
};

struct EvaluationOptions {
  double success_position = 0.25;         ///< an estimate succeeds within this distance (m)
  double success_heading = 0.0872664626;  ///< and this angle (rad; 5 deg)
  double accept_position = 1;             ///< a localized estimate farther away than this (m)
  double accept_heading = 0.2617993878;   ///< or turned by more than this (rad; 15 deg) is a false accept
  double max_gap = 0.5;                   ///< ground truth is not interpolated over longer gaps (s)

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Of one run. Only estimates whose time the ground truth covers are compared.
struct TrajectoryEvaluation {
  int estimates = 0;             ///< all
  int compared = 0;              ///< with ground truth
  int localized = 0;             ///< of those compared, the ones stood by
  int false_accepts = 0;         ///< of those, the ones that are wrong
  double success_share = 0;      ///< of those compared, localized or not; 0 when none
  bool ends_in_success = false;  ///< the last one compared does
  ErrorStatistics position;      ///< of the localized ones, m
  ErrorStatistics heading;       ///< of the localized ones, rad

  /// From the first estimate to the first of those that are localized and succeed with no failure in the half second of
  /// log after them (or the rest of the log, if shorter); s. Nothing: the run never converged.
  std::optional<double> time_to_converge;

  /// As above, of all estimates from convergence on, localized or not.
  ErrorStatistics position_after;
  ErrorStatistics heading_after;
};

/// Compares estimates, in increasing time, with the ground truth.
TrajectoryEvaluation evaluateTrajectory(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth,
                                        const EvaluationOptions& options = {});

ErrorStatistics statisticsOf(std::vector<double> errors);

/// Nothing where the ground truth does not cover the time.
std::optional<PoseError> poseError(const TimedEstimate& estimate, const Trajectory& ground_truth, double max_gap);

}  // namespace vmcl

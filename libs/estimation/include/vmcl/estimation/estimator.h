// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Which minimal samples are drawn: one match with depth and one without (1P1DP), two with depth (2DP), or both.
enum class Solver { automatic, one_point_one_depth, two_depth };

struct EstimatorOptions {
  Solver solver = Solver::automatic;
  int iterations = 500;      ///< random samples drawn
  uint64_t seed = 1;         ///< same seed, same answer
  LikelihoodOptions likelihood;
  int refined = 20;          ///< best hypotheses that are optimized
  int max_modes = 5;         ///< modes reported
  double sigma_tilt = 0;     ///< standard deviation of unmodelled roll and pitch (rad); 0: strictly planar
  double sigma_height = 0;   ///< standard deviation of unmodelled height (m); 0: strictly planar

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// One local maximum of the likelihood.
struct PoseMode {
  PlanarPose robot_in_map;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi), map frame: m, m, rad
  double log_likelihood = 0;                             ///< L at the mode
  double log_weight = 0;                                 ///< log of its share of the mixture (Laplace), <= 0
  int inliers = 0;                                       ///< matches more likely inlier than outlier
};

/// The answer: a mixture of Gaussian modes, most likely first. Empty modes: no pose, and `reason` says why.
struct PoseEstimate {
  std::vector<PoseMode> modes;
  std::vector<int> inliers;  ///< matches that are inliers of the first mode
  Solver solver = Solver::automatic;  ///< kind of the sample that led to the first mode
  std::string reason;

  bool found() const { return !modes.empty(); }
};

/// Estimates the pose of the robot from the matches: samples, scores them by L, optimizes the best and merges them
/// into modes. Throws std::invalid_argument for malformed problems or options; a problem without an answer is no error.
PoseEstimate estimatePose(const PoseProblem& problem, const EstimatorOptions& options);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/pose_refiner.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

struct EstimatorOptions {
  Solver solver = Solver::automatic;
  int iterations = 500;  ///< random samples drawn, at least 1
  uint64_t seed = 1;     ///< same seed, same answer
  LikelihoodOptions likelihood;
  int refined = 20;   ///< best hypotheses that are optimized, at least 1
  int max_modes = 5;  ///< modes reported, at least 1
  SoftPlane plane;    ///< unmodelled tilt and height of the robot

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// The answer: a mixture of Gaussian modes, the heaviest first, each better supported than a pose that fits outliers by
/// chance. No modes: no pose, and `reason` says why.
struct PoseEstimate {
  std::vector<PoseMode> modes;
  std::string reason;

  bool found() const { return !modes.empty(); }
};

/// Estimates the pose of the robot from the matches: draws samples, scores them by the likelihood, optimizes the best
/// and merges them into modes. Throws std::invalid_argument for malformed problems or options; a problem without an
/// answer is no error.
PoseEstimate estimatePose(const PoseProblem& problem, const EstimatorOptions& options);

}  // namespace vmcl

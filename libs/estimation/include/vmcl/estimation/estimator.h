// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vmcl/estimation/degeneracy.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/pose_refiner.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// How the robot may stand.
enum class Motion {
  planar,   ///< on the plane, up to what SoftPlane allows
  upright,  ///< within some 10 m of the plane's height (SoftPlane may say more), tilted as SoftPlane allows: on a ledge
  free      ///< at such heights and anyhow, up to some 60 deg off upright: on a ramp, in somebody's hands
};

struct EstimatorOptions {
  Motion motion = Motion::planar;     ///< the others are fallbacks: they need two or three matches with depth a sample
  Solver solver = Solver::automatic;  ///< for planar motion; otherwise left automatic
  int iterations = 20000;             ///< most random samples drawn, at least 1; easy problems need few
  uint64_t seed = 1;                  ///< same seed, same answer
  LikelihoodOptions likelihood{};
  bool estimate_sigma_px = false;  ///< whether the pixel noise is but a first guess, to be estimated from the inliers
  int refined = 16;                ///< best hypotheses that are optimized, at least 1
  int max_modes = 5;               ///< modes reported, at least 1
  SoftPlane plane{};               ///< unmodelled tilt and height of the robot
  double in_sight_log_odds = 3;    ///< before the matches are seen, that a reference has the place in sight and
                                   ///< not one that looks like it

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Why there is no pose.
enum class NoPose {
  none,                  ///< there is one
  too_few_matches,       ///< fewer than a sample needs
  no_sample,             ///< no sample gives a pose: all matches degenerate, or without depth and of one reference
  unconstrained,         ///< matches agree with a pose but do not fix it to 10 m, or only 100 m from all references
  no_better_than_chance  ///< no pose explains more matches than chance would
};

/// "", "too_few_matches", ...
std::string_view nameOf(NoPose failure);

/// The answer: a mixture of Gaussian modes, the heaviest first, each better supported than a pose that fits outliers by
/// chance. No modes: no pose, and `failure` and `reason` say why.
struct PoseEstimate {
  std::vector<PoseMode> modes;
  NoPose failure = NoPose::none;
  std::string reason;
  std::vector<Degeneracy> degeneracies;  ///< of the first mode's inliers, for planar motion
  double inlier_rate = 0;                ///< share of inliers among matches of odds 1 that the modes were judged with
  double sigma_px = 0;                   ///< and standard deviation of a pixel coordinate
  /// Log of how much better the first mode explains the matches with the robot off its plane (0.1 rad, 0.2 m) than as
  /// SoftPlane allows: over about 5, the data contradict planar motion. 0 for other motions.
  double off_plane_log_odds = 0;

  bool found() const { return !modes.empty(); }
};

/// Estimates the pose of the robot from the matches: draws samples, scores them by the likelihood, optimizes the best
/// and merges them into modes. Throws std::invalid_argument for malformed problems or options; a problem without an
/// answer is no error.
PoseEstimate estimatePose(const PoseProblem& problem, const EstimatorOptions& options);

}  // namespace vmcl

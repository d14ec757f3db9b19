// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

struct LikelihoodOptions {
  double sigma_px = 2;        ///< standard deviation of a pixel coordinate, in either image
  double inlier_prior = 0.3;  ///< chance that a match of odds 1 is an inlier, in (0, 1)
  /// Whether outliers may keep their elevation, as in a level world; how many do is estimated. Else they are uniform.
  bool level_outliers = true;

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// How well a robot pose explains what the cameras saw: the log likelihood ratio of "this pose and noise" against
/// "all are outliers",
///
///     L(pose) = sum over matches of log(1 - e + e p(residual at pose) / u).
///
/// The one score of sampling, refinement, mode weights and particles.
/// - 2D-3D: p is the 2-D Gaussian of the reprojection residual, its covariance the pixel noise plus the point's own
///   covariance carried into the image at that pose, zero behind the camera.
/// - 2D-2D: the point lies somewhere on the reference ray, its inverse depth distributed as that of the matches with
///   depth, or anywhere, and marginalized out; p is a Gaussian across the epipolar segment and spread along it.
/// u is the density of outliers at the query pixel: uniform over the image, or level, as far as the matches show it.
/// The odds of e are the prior's times Match::inlier_odds. A pose that explains nothing scores the sum of log(1 - e).
class PoseLikelihood {
 public:
  /// Prepares once what every pose needs. Throws std::invalid_argument as PoseProblem::check and options.check do.
  PoseLikelihood(const PoseProblem& problem, const LikelihoodOptions& options);
  ~PoseLikelihood();
  PoseLikelihood(PoseLikelihood&&) noexcept;
  PoseLikelihood& operator=(PoseLikelihood&&) noexcept;

  /// The same with another share of inliers and pixel noise, at a part of the cost.
  PoseLikelihood with(double inlier_prior, double sigma_px) const;

  /// L at one pose of the robot. Finite; a pose that is not explains nothing. Thread safe.
  double operator()(const PlanarTransform& map_from_robot) const;
  double operator()(const PlanarPose& map_from_robot) const { return (*this)(PlanarTransform(map_from_robot)); }

  /// L with the robot tilted or lifted off the ground plane.
  double operator()(const Rigid3& map_from_robot) const;

  /// L at many poses, vectorized: the same to 1e-4 at tens of times the speed, for sampling and particles. No value
  /// depends on the other poses. Throws std::invalid_argument when the sizes differ. Thread safe.
  void evaluate(std::span<const PlanarTransform> map_from_robot, std::span<double> log_likelihoods) const;

  int matchCount() const;
  const LikelihoodOptions& options() const;

 private:
  friend class PoseRefiner;
  struct Prepared;
  PoseLikelihood();
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace vmcl

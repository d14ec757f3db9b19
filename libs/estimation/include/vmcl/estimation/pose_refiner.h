// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/planar_slope.h"

namespace vmcl {

/// What the robot may do beside moving on the plane: standard deviations of Gaussian priors on roll and pitch (rad) and
/// height (m). 0 holds the quantity where refinement starts: on the plane, unless told otherwise.
struct SoftPlane {
  double sigma_tilt = 0;
  double sigma_height = 0;

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// A local maximum of the likelihood (times the soft plane's prior), but that the prior of the depth of matches without
/// one pulls less than in L: L compares poses, for which each match counts by itself, while an error of the prior,
/// common to all, would draw them all to one side.
struct RefinedPose {
  PlanarPose map_from_robot;
  double roll = 0, pitch = 0, height = 0;  ///< R = Rz(phi) Ry(pitch) Rx(roll)
  double log_likelihood = 0;               ///< L
  /// Log of the integral of exp(L) times the normalized prior over the peak, all free parameters (Laplace): m^2 rad.
  double log_evidence = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi), the others marginalized
  bool constrained = false;  ///< whether the matches fix all of x, y and phi; else covariance and evidence mean nothing

  Rigid3 rigid() const;
  /// To start from; pitch is within 90 deg.
  static RefinedPose at(const Rigid3& map_from_robot);
};

/// An estimate of the standard deviation of a pixel coordinate, and of how many coordinates it is worth.
struct PixelNoise {
  double sigma_px = 0;
  double freedom = 0;
};

/// A planar pose all but at a maximum of L, and how L is there.
struct ClimbedPose {
  PlanarTransform map_from_robot;
  PlanarSlope slope;
  int start = 0;  ///< index of the pose where the climb began
};

/// Climbs the likelihood: Levenberg-Marquardt on the residuals of each match weighted by its chance of being an inlier
/// (expectation maximization), each step accepted only if the true objective grows; near the top to where the gradient
/// of these residuals vanishes, one place wherever the climb came from, unless that costs more than 0.1 of L.
class PoseRefiner {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// The likelihood must outlive the refiner.
  PoseRefiner(const PoseLikelihood& likelihood, const SoftPlane& plane);

  RefinedPose refine(const RefinedPose& start) const;
  RefinedPose refine(const PlanarTransform& start) const;

  /// Climbs from many poses at once, on the plane and all but to the top, at a small part of the time: to see which are
  /// worth refining. Of climbs that meet only the highest goes on. The highest first.
  std::vector<ClimbedPose> climb(std::span<const PlanarTransform> starts) const;

  /// L, its gradient and Gauss-Newton information over (x, y, phi, roll, pitch, height), matches weighted by
  /// their chance of being inliers. The gradient leaves out how the residuals' spread varies with the pose; the prior
  /// of unknown depths pulls as RefinedPose says.
  struct Linearization {
    double log_likelihood = 0;
    Vector6 gradient = Vector6::Zero();
    Matrix6 information = Matrix6::Zero();
    Matrix6 doubt = Matrix6::Zero();  ///< information lost because it is not sure which matches are inliers
  };
  Linearization linearize(const RefinedPose& pose) const;

  /// The same at many planar poses, vectorized, most of it in single precision. Throws std::invalid_argument when the
  /// sizes differ.
  void linearize(std::span<const PlanarTransform> poses, std::span<PlanarSlope> slopes) const;

  /// As this pose shows them: the share of inliers among matches of odds 1, weighed with the prior's as if of 15 more
  /// matches; and the standard deviation of a pixel coordinate, weighed with the prior's as if of 4 more coordinates:
  /// one step from the likelihood's towards where it fits the inliers' residuals.
  double inlierRate(const RefinedPose& pose, double prior_rate) const;
  PixelNoise pixelNoise(const RefinedPose& pose, double inlier_rate, double prior_sigma_px) const;

  /// Matches more likely inlier than outlier, by increasing index.
  std::vector<int> inliers(const RefinedPose& pose) const;

 private:
  struct Position {
    RefinedPose pose;
    Linearization linear;  ///< with the prior
    double objective = 0;  ///< L and the log prior
  };
  Position at(const RefinedPose& pose) const;
  /// Uphill until a step is expected to gain less than `near`.
  Position climbed(Position best, double near) const;
  /// Where the gradient vanishes or, if no such place is at hand, on top of the objective.
  Position settled(const Position& top) const;

  double logPrior(const RefinedPose& pose) const;
  Linearization withPrior(const RefinedPose& pose) const;
  void setUncertainty(const Linearization& linear, RefinedPose& pose) const;

  const PoseLikelihood& likelihood_;
  Eigen::Vector3d sigma_;  ///< of roll, pitch and height; 0: held
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <optional>
#include <span>

#include "vmcl/estimation/estimator.h"
#include "vmcl/mrpt/odometry_motion_model.h"
#include "vmcl/mrpt/pose_density.h"
#include "vmcl/mrpt/pose_region.h"
#include "vmcl/mrpt/pose_with_covariance.h"
#include "vmcl/mrpt/recovery_averages.h"

namespace vmcl {

/// AMCL's resampling: with a sample size adapted (KLD) at the resampling, where MRPT adapts it at every prediction.
struct AmclResampling {
  int resample_interval = 1;          ///< updates for each resampling
  bool selective_resampling = false;  ///< only when the effective sample size is below half the particles
};

struct PlanarMonteCarloOptions {
  std::optional<OdometryMotionModel> motion_model;  ///< none: each action brings its own noise (MRPT's models)
  std::optional<AmclResampling> amcl_resampling;    ///< none: MRPT's, by its own options
  double slip_probability = 0;                      ///< chance, at each movement, of a wheel that slipped, [0, 0.5]
  double recovery_alpha_slow = 0;        ///< AMCL: decay of the slow average likelihood (e.g. 0.001); 0: no recovery
  double recovery_alpha_fast = 0;        ///< AMCL: decay of the fast one (e.g. 0.1); 0: no recovery
  double injection_share = 0.1;          ///< share of the particles drawn from an image's own estimate; 0: none
  double kidnapping_probability = 0.01;  ///< chance, at each image, that the robot is not where the particles are
  double aliasing_probability = 0.1;     ///< chance that an image looks like another place than where it was taken
  int threads = 1;                       ///< that weigh particles; the result does not depend on it
  uint64_t seed = 1;

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Monte Carlo localization on the plane: MRPT's filter (motion models, KLD-adaptive sample size, metric maps) with
/// - AMCL's recovery from w_slow and w_fast, kept apart for images and for all other sensors. An image's likelihood is
///   there the geometric mean over its matches, whose number differs from image to image, and over that of the pose
///   that explains it best: an image that tells of no place, in front of a blank wall, tells nothing of being lost,
/// - particles injected where an image says the robot may be,
/// - wheels that slip: a few of the particles move as if one wheel had turned too far, by up to half of its way (two
///   wheels 0.3 m apart), so that the noise of all others need not cover it,
/// - weights that are equal after every resampling,
/// - one seed for everything random. MRPT's motion models and resampling draw from its generator of the process, which
///   is lent to them seeded and put back; so filters of one process may take turns, but not run at the same time.
///
/// Injection is a mixture proposal. With the predicted particles' density p, the chance e of kidnapping, the uniform
/// density u of the map, and the image's modes m, the belief before the image is b = (1 - e) p + e u; a share a of the
/// particles is drawn from m, so the proposal is q = (1 - a) p + a m, and each particle weighs b/q before it is
/// weighed by the likelihood. Thus the image is counted once, and the belief does not move towards it by being sampled.
///
/// An image may look like another place, and be consistently wrong. With the chance g of that and the likelihood l(x),
/// it is weighed by (1 - g) l(x) + g z, where z is the mean of l over the map, which the particles tell by importance
/// sampling as far as they cover it. So one image moves the robot to where it has injected particles by odds of no more
/// than about e / g, however sharp it is; two that agree do.
class PlanarMonteCarlo : public mrpt::slam::CMonteCarloLocalization2D {
 public:
  using KldOptions = mrpt::slam::TKLDParams;
  using ParticleFilterOptions = mrpt::bayes::CParticleFilter::TParticleFilterOptions;

  /// Throws std::invalid_argument naming the key that is out of range or asks for what is not supported.
  static void check(const ParticleFilterOptions& options);

  /// `anywhere`: where a lost robot may be. Throws std::invalid_argument naming the bad option.
  PlanarMonteCarlo(mrpt::maps::CMultiMetricMap::ConstPtr map, const KldOptions& kld_options,
                   const ParticleFilterOptions& filter_options, const PlanarMonteCarloOptions& monte_carlo_options,
                   const PoseRegion& anywhere);

  /// Goes on with another map; the particles stay.
  void setMap(mrpt::maps::CMultiMetricMap::ConstPtr map, const PoseRegion& anywhere);

  /// Spreads the particles. Throws std::invalid_argument naming a bad number of particles or pose.
  void start(const PoseRegion& region, int particles);
  void start(const PoseWithCovariance& pose, int particles);

  /// Moves each particle at random, by these standard deviations along each axis (m) and of heading (rad).
  void diffuse(double position_deviation, double heading_deviation);

  /// Draws a share of the particles, chosen at random, anew: at random distances of about 1 m and 30 deg (each a
  /// standard deviation) of where a particle was, or anywhere in the map, if it tells where that is.
  void scatterNearby(double share);
  void scatterAnywhere(double share);

  /// One step: prediction by the action, injection of the modes, weighing by the observations, resampling. Without an
  /// action the robot has stood still; without a frame there is only the prediction. Throws std::runtime_error when the
  /// action's noise or a map's likelihood is not finite, and what a map throws; the particles are then as before.
  void update(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* frame,
              std::span<const PoseMode> modes = {});

  /// Of the last update, before resampling: effective sample size over number of particles, (0, 1].
  double effectiveShare() const { return effective_share_; }

 private:
  template <typename Draw>
  void drawAll(int particles, Draw&& draw);
  void predict(const mrpt::obs::CActionCollection& action);
  /// What one slipping wheel counted too much is taken back from some particles.
  void slip(const PlanarPose& movement);
  void correct(const mrpt::obs::CSensoryFrame& frame, std::span<const PoseMode> modes);
  void inject(std::span<const PoseMode> modes);
  void recover();
  void forgetLikelihoods();
  void weigh(const mrpt::obs::CSensoryFrame& frame, std::span<const PoseMode> modes);
  void judge(RecoveryAverages& recovery, std::span<const double> log_likelihoods, double factor) const;
  PoseDensity density() const;
  void allowForAliasing(std::span<double> log_likelihoods) const;
  void resample();
  void resampleAll();
  void resampleAdaptively();
  void equalizeWeights();
  void normalize();

  /// Replaces a share of the particles, chosen at random; returns the share in whole particles.
  template <typename Draw>
  double replaceParticles(double share, Draw&& draw);

  mrpt::maps::CMultiMetricMap::ConstPtr map_;
  ParticleFilterOptions filter_options_;
  PlanarMonteCarloOptions monte_carlo_options_;
  PoseRegion anywhere_;
  RecoveryAverages image_recovery_;
  RecoveryAverages other_recovery_;
  Random random_;
  std::vector<char> drawn_anew_;  ///< for each particle, whether the update drew it where the prediction had none
  double effective_share_ = 1;
  int updates_ = 0;  ///< since the last resampling
};

}  // namespace vmcl

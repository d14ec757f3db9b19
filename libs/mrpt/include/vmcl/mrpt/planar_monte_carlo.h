// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <optional>
#include <span>

#include "vmcl/estimation/estimator.h"
#include "vmcl/mrpt/pose_region.h"
#include "vmcl/mrpt/recovery_averages.h"

namespace vmcl {

struct PlanarMonteCarloOptions {
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
/// - AMCL's recovery from w_slow and w_fast,
/// - particles injected where an image says the robot may be,
/// - weights that are equal after every resampling,
/// - one seed for everything random.
///
/// Injection is a mixture proposal. With the predicted particles' density p, the chance e of kidnapping, the uniform
/// density u of the map, and the image's modes m, the belief before the image is b = (1 - e) p + e u; a share a of the
/// particles is drawn from m, so the proposal is q = (1 - a) p + a m, and each particle weighs b/q before it is
/// weighed by the likelihood. Thus the image is counted once, and the belief does not move towards it by being sampled.
///
/// An image may look like another place, and be consistently wrong. With the chance g of that and the likelihood l(x),
/// it is weighed by (1 - g) l(x) + g z, where z is the mean of l over the map, which the particles tell by importance
/// sampling. So one image moves the robot elsewhere by odds of no more than about e / g, however sharp it is; two that
/// agree do.
class PlanarMonteCarlo : public mrpt::slam::CMonteCarloLocalization2D {
 public:
  using KldOptions = mrpt::slam::TKLDParams;
  using ParticleFilterOptions = mrpt::bayes::CParticleFilter::TParticleFilterOptions;

  /// `anywhere`: where a lost robot may be. Seeds MRPT's process-wide generator, which the motion models draw from: at
  /// most one filter of a process runs at a time. Throws std::invalid_argument naming the bad option.
  PlanarMonteCarlo(mrpt::maps::CMultiMetricMap::ConstPtr map, const KldOptions& kld_options,
                   const ParticleFilterOptions& filter_options, const PlanarMonteCarloOptions& monte_carlo_options,
                   const PoseRegion& anywhere);

  /// Spreads the particles.
  void start(const PoseRegion& region, int particles);

  /// One step: prediction by the action, injection of the modes, weighing by the observations, resampling. Without an
  /// action the robot has stood still; without a frame there is only the prediction. Throws std::runtime_error when a
  /// map gives a likelihood that is not finite.
  void update(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* frame,
              std::span<const PoseMode> modes = {});

  /// Of the last update, before resampling: effective sample size over number of particles, (0, 1].
  double effectiveShare() const { return effective_share_; }

 private:
  void runStockAlgorithm(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* frame);
  void predict(const mrpt::obs::CActionCollection& action);
  std::vector<double> inject(std::span<const PoseMode> modes);
  void weigh(const mrpt::obs::CSensoryFrame& frame, std::span<const double> log_uniform_ratios);
  void allowForAliasing(std::span<const double> log_uniform_ratios, std::span<double> log_likelihoods) const;
  void resample();
  void equalizeWeights();
  void normalize();

  template <typename Draw>
  void replaceParticles(std::size_t count, Draw&& draw);

  mrpt::maps::CMultiMetricMap::ConstPtr map_;
  ParticleFilterOptions filter_options_;
  PlanarMonteCarloOptions monte_carlo_options_;
  PoseRegion anywhere_;
  RecoveryAverages recovery_;
  Random random_;
  double effective_share_ = 1;
};

}  // namespace vmcl

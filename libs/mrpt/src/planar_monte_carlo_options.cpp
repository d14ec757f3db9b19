// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "vmcl/mrpt/planar_monte_carlo.h"

namespace vmcl {
namespace {

using mrpt::bayes::CParticleFilter;

void checkShare(const char* name, double value, double high) {
  if (!(value >= 0 && value <= high))
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + " is not in [0, " +
                                std::to_string(high) + "]");
}

}  // namespace

void PlanarMonteCarloOptions::check() const {
  RecoveryAverages(recovery_alpha_slow, recovery_alpha_fast);
  checkShare("injection_share", injection_share, 0.9);
  checkShare("kidnapping_probability", kidnapping_probability, 0.5);
  checkShare("aliasing_probability", aliasing_probability, 0.5);
  if (motion_model) motion_model->check();
  if (amcl_resampling && amcl_resampling->resample_interval < 1)
    throw std::invalid_argument("resample_interval = " + std::to_string(amcl_resampling->resample_interval) +
                                " is not positive");
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("threads = " + std::to_string(threads) + " is not in [1, 1024]");
}

void PlanarMonteCarlo::check(const ParticleFilterOptions& options) {
  if (options.PF_algorithm != CParticleFilter::pfStandardProposal)
    throw std::invalid_argument("PF_algorithm = " + std::to_string(options.PF_algorithm) +
                                " is not supported, only 0 (pfStandardProposal)");
  if (options.adaptiveSampleSize && options.resamplingMethod != CParticleFilter::prMultinomial)
    throw std::invalid_argument("adaptiveSampleSize needs resamplingMethod = 0 (prMultinomial)");
  checkShare("BETA", options.BETA, 1);
  if (!(options.powFactor > 0 && options.powFactor <= 1))
    throw std::invalid_argument("powFactor = " + std::to_string(options.powFactor) + " is not in (0, 1]");
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>
#include <utility>

#include "option_range.h"
#include "vmcl/mrpt/planar_monte_carlo.h"

namespace vmcl {

using mrpt::bayes::CParticleFilter;

void PlanarMonteCarloOptions::check() const {
  RecoveryAverages(recovery_alpha_slow, recovery_alpha_fast);
  demand(injection_share >= 0 && injection_share <= 0.9, "injection_share", injection_share, "in [0, 0.9]");
  for (const auto& [key, chance] : {std::pair{"slip_probability", slip_probability},
                                    {"kidnapping_probability", kidnapping_probability},
                                    {"aliasing_probability", aliasing_probability}})
    demand(chance >= 0 && chance <= 0.5, key, chance, "in [0, 0.5]");
  if (motion_model) motion_model->check();
  if (amcl_resampling)
    demand(amcl_resampling->resample_interval >= 1, "resample_interval", amcl_resampling->resample_interval,
           "at least 1");
  demand(threads >= 1 && threads <= 1024, "threads", threads, "in [1, 1024]");
}

void PlanarMonteCarlo::check(const ParticleFilterOptions& options) {
  if (options.PF_algorithm != CParticleFilter::pfStandardProposal)
    throw std::invalid_argument("PF_algorithm = " + std::to_string(options.PF_algorithm) +
                                " is not supported, only 0 (pfStandardProposal)");
  if (options.adaptiveSampleSize && options.resamplingMethod != CParticleFilter::prMultinomial)
    throw std::invalid_argument("adaptiveSampleSize needs resamplingMethod = 0 (prMultinomial)");
  demand(options.BETA >= 0 && options.BETA <= 1, "BETA", options.BETA, "in [0, 1]");
  demand(options.powFactor > 0 && options.powFactor <= 1, "powFactor", options.powFactor, "in (0, 1]");
}

}  // namespace vmcl

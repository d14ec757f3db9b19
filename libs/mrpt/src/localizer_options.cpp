// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localizer_options.h"

#include <string>

#include "option_range.h"
#include "vmcl/mrpt/kld_sample_size.h"

namespace vmcl {
void LocalizedRule::check() const {
  demandPositive("max_position_deviation", max_position_deviation);
  demandPositive("max_heading_deviation_deg", max_heading_deviation / degree);
  demand(min_share > 0 && min_share <= 1, "min_share", min_share, "in (0, 1]");
  demand(min_frames >= 1, "min_frames", min_frames, "at least 1");
}

LocalizerOptions LocalizerOptions::amcl() {
  LocalizerOptions options;
  options.particles_count = 2000;
  options.update_min_d = 0.25;
  options.update_min_a = 0.2;
  options.kld.KLD_minSampleSize = 500;
  options.kld.KLD_maxSampleSize = 2000;
  options.kld.KLD_epsilon = 0.05;
  options.kld.KLD_delta = 0.01;
  options.kld.KLD_binSize_XY = 0.5;
  options.kld.KLD_binSize_PHI = 10 * degree;
  options.monte_carlo.motion_model.emplace();
  options.monte_carlo.amcl_resampling.emplace();
  return options;
}

void LocalizerOptions::check() const {
  demand(particles_count >= 1 && particles_count <= KldSampleSize::most_particles, "particles_count", particles_count,
         "in [1, " + std::to_string(KldSampleSize::most_particles) + "]");
  demandNotNegative("update_min_d", update_min_d);
  demandNotNegative("update_min_a", update_min_a);
  demandNotNegative("guided_updates", guided_updates);
  KldSampleSize{kld};
  PlanarMonteCarlo::check(filter);
  monte_carlo.check();
  localized.check();
  health.check();
}

}  // namespace vmcl

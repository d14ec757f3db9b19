// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "mrpt_draws.h"
#include "vmcl/mrpt/kld_sample_size.h"
#include "vmcl/mrpt/planar_monte_carlo.h"

namespace vmcl {

/// Weights that sum to one; MRPT's normalizeWeights() makes the largest one.
void PlanarMonteCarlo::normalize() {
  normalizeWeights();
  double sum = 0;
  for (const auto& particle : m_particles) sum += std::exp(particle.log_w);
  if (!(sum > 0 && std::isfinite(sum))) throw std::runtime_error("the particles' weights are not finite");
  const double log_sum = std::log(sum);
  for (auto& particle : m_particles) particle.log_w -= log_sum;
}

/// What is replaced is drawn at random, so it must not matter which particle it is.
void PlanarMonteCarlo::equalizeWeights() {
  const auto is_first = [&](const auto& particle) { return particle.log_w == m_particles.front().log_w; };
  if (std::all_of(m_particles.begin(), m_particles.end(), is_first)) return;
  resampleAll();
}

/// The count is given because performResampling equalizes the weights of that many particles, of none by default.
void PlanarMonteCarlo::resampleAll() {
  const MrptDraws draws(random_);
  performResampling(filter_options_, m_particles.size());
  normalize();
}

void PlanarMonteCarlo::resample() {
  effective_share_ = ESS();
  if (const auto& amcl = monte_carlo_options_.amcl_resampling) {
    constexpr double needs_resampling = 0.5;
    if (++updates_ < amcl->resample_interval) return;
    if (!amcl->selective_resampling || effective_share_ < needs_resampling) resampleAdaptively();
    updates_ = 0;
    return;
  }
  if (filter_options_.adaptiveSampleSize || effective_share_ >= filter_options_.BETA) return;
  resampleAll();
}

/// Draws particles until there are as many as the places where they lie ask for.
void PlanarMonteCarlo::resampleAdaptively() {
  std::vector<double> cumulative;
  double sum = 0;
  for (const auto& particle : m_particles) cumulative.push_back(sum += std::exp(particle.log_w));
  KldSampleSize size(options.KLD_params);
  CParticleList drawn;
  for (std::size_t needed = 1; drawn.size() < needed;) {
    const auto chosen = std::upper_bound(cumulative.begin(), std::prev(cumulative.end()), sum * random_.uniform());
    drawn.push_back(m_particles[static_cast<std::size_t>(chosen - cumulative.begin())]);
    drawn.back().log_w = 0;
    needed = size.add({drawn.back().d.x, drawn.back().d.y, drawn.back().d.phi});
  }
  m_particles = std::move(drawn);
  normalize();
}

}  // namespace vmcl

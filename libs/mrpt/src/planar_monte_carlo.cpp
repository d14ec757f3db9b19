// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/planar_monte_carlo.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "vmcl/mrpt/mode_mixture.h"
#include "vmcl/mrpt/pose_density.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {
namespace {

using mrpt::bayes::CParticleFilter;

void checkShare(const char* name, double value, double high) {
  if (!(value >= 0 && value <= high))
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + " is not in [0, " +
                                std::to_string(high) + "]");
}

PlanarPose planarPose(const mrpt::math::TPose2D& pose) { return {pose.x, pose.y, pose.phi}; }

double logSumExp(std::span<const double> values) {
  const double top = *std::max_element(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += std::exp(value - top);
  return top + std::log(sum);
}

/// MRPT's generator as new: randomize() alone would keep the spare half of its last pair of normal numbers.
void seedMrpt(uint64_t seed) {
  mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(static_cast<uint32_t>(seed ^ (seed >> 32)));
}

}  // namespace

void PlanarMonteCarloOptions::check() const {
  RecoveryAverages(recovery_alpha_slow, recovery_alpha_fast);
  checkShare("injection_share", injection_share, 0.9);
  checkShare("kidnapping_probability", kidnapping_probability, 0.5);
  checkShare("aliasing_probability", aliasing_probability, 0.5);
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("threads = " + std::to_string(threads) + " is not in [1, 1024]");
}

PlanarMonteCarlo::PlanarMonteCarlo(mrpt::maps::CMultiMetricMap::ConstPtr map, const KldOptions& kld_options,
                                   const ParticleFilterOptions& filter_options,
                                   const PlanarMonteCarloOptions& monte_carlo_options, const PoseRegion& anywhere)
    : map_(std::move(map)),
      filter_options_(filter_options),
      monte_carlo_options_(monte_carlo_options),
      anywhere_(anywhere),
      recovery_(monte_carlo_options.recovery_alpha_slow, monte_carlo_options.recovery_alpha_fast),
      random_(monte_carlo_options.seed, 1) {
  monte_carlo_options_.check();
  if (filter_options_.adaptiveSampleSize && filter_options_.resamplingMethod != CParticleFilter::prMultinomial)
    throw std::invalid_argument("adaptiveSampleSize needs resamplingMethod = 0 (prMultinomial)");
  options.metricMap = map_;
  options.KLD_params = kld_options;
  seedMrpt(monte_carlo_options.seed);
}

void PlanarMonteCarlo::start(const PoseRegion& region, int particles) {
  if (particles < 1) throw std::invalid_argument("particles_count = " + std::to_string(particles) + " is not positive");
  m_particles.resize(static_cast<std::size_t>(particles));
  for (auto& particle : m_particles) {
    const PlanarPose pose = region.draw(random_);
    particle.d = {pose.x, pose.y, pose.phi};
    particle.log_w = 0;
  }
  normalize();
}

void PlanarMonteCarlo::update(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* frame,
                              std::span<const PoseMode> modes) {
  if (filter_options_.PF_algorithm != CParticleFilter::pfStandardProposal) return runStockAlgorithm(action, frame);
  if (action) predict(*action);
  if (!frame) return;
  weigh(*frame, inject(modes));
  resample();
}

void PlanarMonteCarlo::runStockAlgorithm(const mrpt::obs::CActionCollection* action,
                                         const mrpt::obs::CSensoryFrame* frame) {
  prediction_and_update(action, frame, filter_options_);
  normalize();
  effective_share_ = ESS();
}

/// Weights that sum to one; MRPT's normalizeWeights() makes the largest one.
void PlanarMonteCarlo::normalize() {
  normalizeWeights();
  double sum = 0;
  for (const auto& particle : m_particles) sum += std::exp(particle.log_w);
  for (auto& particle : m_particles) particle.log_w -= std::log(sum);
}

void PlanarMonteCarlo::predict(const mrpt::obs::CActionCollection& action) {
  if (!action.getBestMovementEstimation() && !action.getActionByClass<mrpt::obs::CActionRobotMovement3D>()) return;
  prediction_and_update_pfStandardProposal(&action, nullptr, filter_options_);
  normalize();
}

/// What is replaced is drawn at random, so it must not matter which particle it is. An adaptive sample size has drawn
/// them anew in the prediction.
void PlanarMonteCarlo::equalizeWeights() {
  if (filter_options_.adaptiveSampleSize) return;
  performResampling(filter_options_, m_particles.size());
  normalize();
}

template <typename Draw>
void PlanarMonteCarlo::replaceParticles(std::size_t count, Draw&& draw) {
  const std::size_t size = m_particles.size();
  for (std::size_t i = 0; i < count; ++i)
    std::swap(m_particles[i], m_particles[i + random_.below(static_cast<uint32_t>(size - i))]);
  double kept = 0;
  for (std::size_t i = count; i < size; ++i) kept += std::exp(m_particles[i].log_w);
  const double share = static_cast<double>(count) / static_cast<double>(size);
  for (std::size_t i = 0; i < count; ++i) {
    const PlanarPose pose = draw();
    m_particles[i].d = {pose.x, pose.y, pose.phi};
    m_particles[i].log_w = -std::log(static_cast<double>(size));
  }
  for (std::size_t i = count; i < size; ++i) m_particles[i].log_w += std::log1p(-share) - std::log(kept);
}

/// Returns the logarithm of uniform density over proposal density for each particle, or nothing if no image was used.
std::vector<double> PlanarMonteCarlo::inject(std::span<const PoseMode> modes) {
  const double lost_share = recovery_.enabled() ? recovery_.randomShare() : 0;
  const double size = static_cast<double>(m_particles.size());
  const auto countOf = [&](double share) { return static_cast<std::size_t>(std::min(share, 0.95) * size); };
  if (lost_share > 0) recovery_.restart();
  if (modes.empty() || monte_carlo_options_.injection_share == 0 || anywhere_.volume() == 0) {
    if (const std::size_t count = countOf(lost_share); count > 0) {
      equalizeWeights();
      replaceParticles(count, [&] { return anywhere_.draw(random_); });
    }
    return {};
  }
  const double kidnapped = std::max(lost_share, monte_carlo_options_.kidnapping_probability);
  const std::size_t count = countOf(std::max(lost_share, monte_carlo_options_.injection_share));
  if (count == 0) return {};
  equalizeWeights();
  PoseDensity predicted;
  for (const auto& particle : m_particles) predicted.add(planarPose(particle.d), std::exp(particle.log_w));
  const ModeMixture mixture(modes);
  replaceParticles(count, [&] { return mixture.draw(random_); });
  const double share = static_cast<double>(count) / size;
  const double uniform = 1 / anywhere_.volume();
  std::vector<double> log_uniform_ratios;
  for (auto& particle : m_particles) {
    const PlanarPose pose = planarPose(particle.d);
    const double density = predicted(pose);
    const double belief = (1 - kidnapped) * density + kidnapped * uniform;
    const double proposal = (1 - share) * density + share * mixture.density(pose);
    particle.log_w += std::log(std::max(belief, std::numeric_limits<double>::min()) / proposal);
    log_uniform_ratios.push_back(std::log(uniform / proposal));
  }
  return log_uniform_ratios;
}

void PlanarMonteCarlo::allowForAliasing(std::span<const double> log_uniform_ratios,
                                        std::span<double> log_likelihoods) const {
  const double aliasing = monte_carlo_options_.aliasing_probability;
  if (log_uniform_ratios.empty() || aliasing == 0) return;
  std::vector<double> weighed(log_likelihoods.begin(), log_likelihoods.end());
  for (std::size_t i = 0; i < weighed.size(); ++i) weighed[i] += log_uniform_ratios[i];
  const double log_mean = logSumExp(weighed) - std::log(static_cast<double>(weighed.size()));
  for (double& value : log_likelihoods)
    value = logSumExp(std::array{value + std::log1p(-aliasing), log_mean + std::log(aliasing)});
}

void PlanarMonteCarlo::weigh(const mrpt::obs::CSensoryFrame& frame, std::span<const double> log_uniform_ratios) {
  std::vector<PlanarPose> poses;
  std::vector<mrpt::poses::CPose3D> mrpt_poses;
  for (const auto& particle : m_particles) {
    poses.push_back(planarPose(particle.d));
    mrpt_poses.emplace_back(mrpt::math::TPose3D(particle.d));
  }
  std::vector<double> of_images(poses.size()), of_others(poses.size());
  bool others = false;
  for (const auto& observation : frame)
    for (const auto& map : map_->maps) {
      if (!map->canComputeObservationLikelihood(*observation)) continue;
      if (const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get())) {
        relocalizing->addLogLikelihoods(*observation, poses, monte_carlo_options_.threads, of_images);
        continue;
      }
      others = true;
      for (std::size_t i = 0; i < poses.size(); ++i)
        of_others[i] += map->computeObservationLikelihood(*observation, mrpt_poses[i]);
    }
  allowForAliasing(log_uniform_ratios, of_images);
  std::vector<double> weighed_others;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double& log_weight = m_particles[i].log_w;
    weighed_others.push_back(log_weight + of_others[i] * filter_options_.powFactor);
    log_weight = weighed_others.back() + of_images[i] * filter_options_.powFactor;
    if (!std::isfinite(log_weight)) throw std::runtime_error("a map gave a likelihood that is not finite");
  }
  if (others && recovery_.enabled()) recovery_.add(logSumExp(weighed_others));
  normalize();
}

void PlanarMonteCarlo::resample() {
  effective_share_ = ESS();
  if (filter_options_.adaptiveSampleSize || effective_share_ >= filter_options_.BETA) return;
  // The count is given because performResampling equalizes the weights of that many particles, of none by default.
  performResampling(filter_options_, m_particles.size());
  normalize();
}

}  // namespace vmcl

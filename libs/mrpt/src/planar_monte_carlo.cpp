// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/planar_monte_carlo.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "mrpt_draws.h"
#include "vmcl/mrpt/kld_sample_size.h"
#include "vmcl/mrpt/mode_mixture.h"
#include "vmcl/mrpt/movement.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {
namespace {

PlanarPose planarPose(const mrpt::math::TPose2D& pose) { return {pose.x, pose.y, pose.phi}; }

mrpt::math::TPose2D mrptPose(const PlanarPose& pose) { return {pose.x, pose.y, pose.phi}; }

double logSumExp(std::span<const double> values) {
  const double top = *std::max_element(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += std::exp(value - top);
  return top + std::log(sum);
}

bool allFinite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

PlanarMonteCarlo::PlanarMonteCarlo(mrpt::maps::CMultiMetricMap::ConstPtr map, const KldOptions& kld_options,
                                   const ParticleFilterOptions& filter_options,
                                   const PlanarMonteCarloOptions& monte_carlo_options, const PoseRegion& anywhere)
    : map_(std::move(map)),
      filter_options_(filter_options),
      monte_carlo_options_(monte_carlo_options),
      anywhere_(anywhere),
      image_recovery_(monte_carlo_options.recovery_alpha_slow, monte_carlo_options.recovery_alpha_fast),
      other_recovery_(image_recovery_),
      random_(monte_carlo_options.seed, 1) {
  monte_carlo_options_.check();
  check(filter_options_);
  if (monte_carlo_options_.amcl_resampling) {
    KldSampleSize{kld_options};                  // throws for bad options
    filter_options_.adaptiveSampleSize = false;  // at the prediction
  }
  clearParticles();  // MRPT begins with one
  options.metricMap = map_;
  options.KLD_params = kld_options;
}

void PlanarMonteCarlo::setMap(mrpt::maps::CMultiMetricMap::ConstPtr map, const PoseRegion& anywhere) {
  map_ = std::move(map);
  options.metricMap = map_;
  anywhere_ = anywhere;
  forgetLikelihoods();
}

/// Those of another map or start tell nothing of being lost.
void PlanarMonteCarlo::forgetLikelihoods() {
  const PlanarMonteCarloOptions& rates = monte_carlo_options_;
  image_recovery_ = other_recovery_ = RecoveryAverages(rates.recovery_alpha_slow, rates.recovery_alpha_fast);
}

template <typename Draw>
void PlanarMonteCarlo::drawAll(int particles, Draw&& draw) {
  if (particles < 1) throw std::invalid_argument("particles_count = " + std::to_string(particles) + " is not positive");
  m_particles.resize(static_cast<std::size_t>(particles));
  for (auto& particle : m_particles) {
    particle.d = mrptPose(draw());
    particle.log_w = 0;
  }
  updates_ = 0;
  forgetLikelihoods();
  normalize();
}

void PlanarMonteCarlo::start(const PoseRegion& region, int particles) {
  drawAll(particles, [&] { return region.draw(random_); });
}

void PlanarMonteCarlo::start(const PoseWithCovariance& pose, int particles) {
  pose.check();
  drawAll(particles, pose.sampler(random_));
}

void PlanarMonteCarlo::diffuse(double position_deviation, double heading_deviation) {
  for (auto& particle : m_particles) {
    particle.d.x += position_deviation * random_.normal();
    particle.d.y += position_deviation * random_.normal();
    particle.d.phi = wrapAngle(particle.d.phi + heading_deviation * random_.normal());
  }
}

void PlanarMonteCarlo::scatterNearby(double share) {
  constexpr double distance = 1.0, turn = 30 * degree;  // standard deviations: m, rad
  replaceParticles(share, [&] {
    const PlanarPose from = planarPose(m_particles[random_.below(static_cast<uint32_t>(m_particles.size()))].d);
    return PlanarPose{from.x + distance * random_.normal(), from.y + distance * random_.normal(),
                      wrapAngle(from.phi + turn * random_.normal())};
  });
}

void PlanarMonteCarlo::scatterAnywhere(double share) {
  if (anywhere_.volume() > 0) replaceParticles(share, [&] { return anywhere_.draw(random_); });
}

void PlanarMonteCarlo::update(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* frame,
                              std::span<const PoseMode> modes) {
  const CParticleList before = m_particles;
  try {
    if (action) predict(*action);
    if (frame) correct(*frame, modes);
  } catch (...) {
    m_particles = before;
    throw;
  }
}

void PlanarMonteCarlo::correct(const mrpt::obs::CSensoryFrame& frame, std::span<const PoseMode> modes) {
  drawn_anew_.assign(m_particles.size(), false);
  recover();
  inject(modes);
  weigh(frame, modes);
  resample();
}

void PlanarMonteCarlo::predict(const mrpt::obs::CActionCollection& action) {
  const auto movement = movementOf(&action);
  if (!movement) return;
  const PlanarPose mean{movement->mean.x(), movement->mean.y(), movement->mean.phi()};
  if (const auto& model = monte_carlo_options_.motion_model) {
    for (auto& particle : m_particles) particle.d = mrptPose(planarPose(particle.d) * model->draw(mean, random_));
  } else {
    const MrptDraws draws(random_);
    prediction_and_update_pfStandardProposal(&action, nullptr, filter_options_);
  }
  slip(mean);
  for (const auto& particle : m_particles)
    if (!isFinite(planarPose(particle.d))) throw std::runtime_error("a movement whose noise is not finite");
  normalize();
}

void PlanarMonteCarlo::slip(const PlanarPose& movement) {
  constexpr double most_of_way = 0.5;  // by which a wheel slips
  constexpr double track = 0.3;        // m between the wheels of a small robot; those of a large one turn it less
  const double chance = monte_carlo_options_.slip_probability;
  if (chance == 0) return;
  for (auto& particle : m_particles) {
    if (random_.uniform() >= chance) continue;
    const double side = random_.uniform() < 0.5 ? 1 : -1;  // the right wheel or the left
    const double way = movement.x + side * 0.5 * track * movement.phi, slipped = random_.uniform(0, most_of_way) * way;
    particle.d = mrptPose(planarPose(particle.d) * PlanarPose{-0.5 * slipped, 0, -side * slipped / track});
  }
}

template <typename Draw>
double PlanarMonteCarlo::replaceParticles(double share, Draw&& draw) {
  const std::size_t size = m_particles.size();
  const auto count = static_cast<std::size_t>(share * static_cast<double>(size));
  if (count == 0) return 0;
  drawn_anew_.resize(size);
  equalizeWeights();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t chosen = i + random_.below(static_cast<uint32_t>(size - i));
    std::swap(m_particles[i], m_particles[chosen]);
    drawn_anew_[chosen] = drawn_anew_[i];
    drawn_anew_[i] = true;
    m_particles[i].d = mrptPose(draw());
  }
  return static_cast<double>(count) / static_cast<double>(size);
}

void PlanarMonteCarlo::recover() {
  constexpr double max_share = 0.9;
  const double lost_share = std::max(image_recovery_.randomShare(), other_recovery_.randomShare());
  scatterAnywhere(std::min(lost_share, max_share));
}

void PlanarMonteCarlo::inject(std::span<const PoseMode> modes) {
  if (modes.empty() || monte_carlo_options_.injection_share == 0 || anywhere_.volume() == 0) return;
  const PoseDensity predicted = density();
  const ModeMixture mixture(modes);
  const double share = replaceParticles(monte_carlo_options_.injection_share, [&] { return mixture.draw(random_); });
  if (share == 0) return;
  const double kidnapped = monte_carlo_options_.kidnapping_probability;
  for (auto& particle : m_particles) {
    const PlanarPose pose = planarPose(particle.d);
    const double belief = (1 - kidnapped) * predicted(pose) + kidnapped / anywhere_.volume();
    const double proposal = (1 - share) * predicted(pose) + share * mixture.density(pose);
    particle.log_w += std::log(std::max(belief, std::numeric_limits<double>::min()) / proposal);
  }
}

/// Of the weighted particles.
PoseDensity PlanarMonteCarlo::density() const {
  PoseDensity density;
  for (const auto& particle : m_particles) density.add(planarPose(particle.d), std::exp(particle.log_w));
  return density;
}

void PlanarMonteCarlo::allowForAliasing(std::span<double> log_likelihoods) const {
  const double aliasing = monte_carlo_options_.aliasing_probability;
  if (aliasing == 0 || anywhere_.volume() == 0) return;
  const PoseDensity belief = density();
  std::vector<double> over_the_map(log_likelihoods.begin(), log_likelihoods.end());
  for (std::size_t i = 0; i < over_the_map.size(); ++i) {
    const auto& particle = m_particles[i];
    const double density = belief(planarPose(particle.d));  // 0 where the weight underflows
    over_the_map[i] += density > 0 ? particle.log_w - std::log(anywhere_.volume() * density)
                                   : -std::numeric_limits<double>::infinity();
  }
  const double log_mean = logSumExp(over_the_map);
  for (double& value : log_likelihoods)
    value = logSumExp(std::array{value + std::log1p(-aliasing), log_mean + std::log(aliasing)});
}

/// By the particles that the prediction brought: those drawn anew would make the mean fall, and it more of them.
void PlanarMonteCarlo::judge(RecoveryAverages& recovery, std::span<const double> log_likelihoods, double factor) const {
  std::vector<double> log_weights, log_products;
  for (std::size_t i = 0; i < m_particles.size(); ++i) {
    if (drawn_anew_[i]) continue;
    log_weights.push_back(m_particles[i].log_w);
    log_products.push_back(m_particles[i].log_w + factor * log_likelihoods[i]);
  }
  if (!log_weights.empty()) recovery.add(logSumExp(log_products) - logSumExp(log_weights));
}

void PlanarMonteCarlo::weigh(const mrpt::obs::CSensoryFrame& frame, std::span<const PoseMode> modes) {
  const std::size_t size = m_particles.size();
  std::vector<PlanarPose> poses;
  for (const auto& particle : m_particles) poses.push_back(planarPose(particle.d));
  for (const PoseMode& mode : modes) poses.push_back(mode.robot_in_map);
  std::vector<double> of_images(poses.size()), of_others(size);
  double matches = 0;
  bool others = false;
  for (const auto& observation : frame)
    for (const auto& map : map_->maps) {
      if (!map->canComputeObservationLikelihood(*observation)) continue;
      if (const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get())) {
        matches += relocalizing->addLogLikelihoods(*observation, poses, monte_carlo_options_.threads, of_images);
        continue;
      }
      others = true;
      for (std::size_t i = 0; i < size; ++i)
        of_others[i] += map->computeObservationLikelihood(*observation,
                                                          mrpt::poses::CPose3D(mrpt::math::TPose3D(m_particles[i].d)));
    }
  if (!allFinite(of_images) || !allFinite(of_others))
    throw std::runtime_error("a map gave a likelihood that is not finite");
  if (others) judge(other_recovery_, of_others, filter_options_.powFactor);
  if (matches > 0) {
    const double best = *std::max_element(of_images.begin(), of_images.end());
    of_images.resize(size);
    for (double& value : of_images) value -= best;
    judge(image_recovery_, of_images, 1 / matches);
    allowForAliasing(of_images);
  }
  for (std::size_t i = 0; i < size; ++i)
    m_particles[i].log_w += (of_others[i] + of_images[i]) * filter_options_.powFactor;
  normalize();
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/likelihood.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "prepared_matches.h"

namespace vmcl {

void LikelihoodOptions::check() const {
  if (!std::isfinite(sigma_px) || !(sigma_px > 0))
    throw std::invalid_argument("sigma_px must be positive and finite, not " + std::to_string(sigma_px));
  if (!(inlier_prior > 0 && inlier_prior < 1))
    throw std::invalid_argument("inlier_prior must be between 0 and 1, not " + std::to_string(inlier_prior));
}

PoseLikelihood::Prepared::Prepared(const PoseProblem& problem, const LikelihoodOptions& likelihood_options)
    : options(likelihood_options), inverse_depth_prior(inverseDepthPrior(problem)), matches(problem) {
  if (options.level_outliers) outlier_density.emplace(problem);
  if (std::ranges::any_of(problem.matches, [](const Match& match) { return match.inlier_odds != 1; }))
    for (const Match& match : problem.matches) inlier_odds.push_back(match.inlier_odds);
  weighMatches();
}

PoseLikelihood::Prepared::Prepared(const Prepared& other, const LikelihoodOptions& likelihood_options)
    : options(likelihood_options),
      inverse_depth_prior(other.inverse_depth_prior),
      outlier_density(other.outlier_density),
      matches(other.matches),
      inlier_odds(other.inlier_odds) {
  weighMatches();
}

void PoseLikelihood::Prepared::weighMatches() {
  const double odds = options.inlier_prior / (1 - options.inlier_prior);
  outlier_sum = inlier_odds.empty() ? -matches.match_count * std::log1p(odds) : 0;
  for (const double of_match : inlier_odds) outlier_sum -= std::log1p(odds * of_match);
  if (!outlier_density && inlier_odds.empty()) return;
  std::vector<double> worth = inlier_odds;
  worth.resize(static_cast<std::size_t>(matches.match_count), 1);
  if (outlier_density) {
    const std::vector<double> density = outlier_density->at(options.inlier_prior);
    for (std::size_t i = 0; i < worth.size(); ++i) worth[i] /= density[i];
  }
  matches.setWorth(worth);
}

const std::optional<LikelihoodTerms>& PoseLikelihood::Prepared::terms() const {
  std::call_once(terms_asked_for_,
                 [&] { terms_ = likelihoodTerms(matches, options, inverse_depth_prior, outlier_sum); });
  return terms_;
}

PoseLikelihood::PoseLikelihood(const PoseProblem& problem, const LikelihoodOptions& options) {
  problem.check();
  options.check();
  prepared_ = std::make_unique<Prepared>(problem, options);
}

PoseLikelihood PoseLikelihood::with(double inlier_prior, double sigma_px) const {
  LikelihoodOptions options = prepared_->options;
  options.inlier_prior = inlier_prior;
  options.sigma_px = sigma_px;
  options.check();
  PoseLikelihood other;
  other.prepared_ = std::make_unique<Prepared>(*prepared_, options);
  return other;
}

PoseLikelihood::PoseLikelihood() = default;
PoseLikelihood::~PoseLikelihood() = default;
PoseLikelihood::PoseLikelihood(PoseLikelihood&&) noexcept = default;
PoseLikelihood& PoseLikelihood::operator=(PoseLikelihood&&) noexcept = default;

const LikelihoodOptions& PoseLikelihood::options() const { return prepared_->options; }

int PoseLikelihood::matchCount() const { return prepared_->matches.match_count; }

double PoseLikelihood::operator()(const Rigid3& map_from_robot) const {
  const Prepared& p = *prepared_;
  LogLikelihoodSum sum(p.options.inlier_prior, p.outlier_sum);
  p.visit<false>(map_from_robot, [&](int, const MatchResidual& residual) { sum.add(residual.likelihood_ratio); });
  return sum.total();
}

double PoseLikelihood::operator()(const PlanarTransform& map_from_robot) const {
  return (*this)(map_from_robot.rigid());
}

void PoseLikelihood::evaluate(std::span<const PlanarTransform> map_from_robot,
                              std::span<double> log_likelihoods) const {
  if (map_from_robot.size() != log_likelihoods.size())
    throw std::invalid_argument("PoseLikelihood::evaluate: " + std::to_string(map_from_robot.size()) + " poses but " +
                                std::to_string(log_likelihoods.size()) + " results");
  const auto& terms = prepared_->terms();
  if (terms) evaluateTerms(*terms, map_from_robot, log_likelihoods);
  for (std::size_t i = 0; i < map_from_robot.size(); ++i)
    if (!terms || !isWithinReach(*terms, map_from_robot[i])) log_likelihoods[i] = (*this)(map_from_robot[i]);
}

}  // namespace vmcl

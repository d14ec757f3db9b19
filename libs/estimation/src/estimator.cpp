// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/estimator.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "minimal_sampler.h"
#include "vmcl/estimation/sample_consensus.h"

namespace vmcl {

void EstimatorOptions::check() const {
  const auto positive = [](const char* key, int value) {
    if (value < 1) throw std::invalid_argument(std::string(key) + " must be at least 1, not " + std::to_string(value));
  };
  positive("iterations", iterations);
  positive("refined", refined);
  positive("max_modes", max_modes);
  likelihood.check();
  plane.check();
}

namespace {

struct Hypothesis {
  PlanarTransform pose;
  Solver solver;
};

/// Samples of the wanted kinds; each kind draws all iterations that are its share.
std::vector<Hypothesis> drawHypotheses(const PoseProblem& problem, const EstimatorOptions& options) {
  const MinimalSampler sampler(problem);
  const bool one = options.solver != Solver::two_depth && sampler.canDrawOnePointOneDepth();
  const bool two = options.solver != Solver::one_point_one_depth && sampler.canDrawTwoDepth();
  const int of_two = two ? (one ? options.iterations / 2 : options.iterations) : 0;
  Random random(options.seed);
  std::vector<Hypothesis> hypotheses;
  std::vector<PlanarTransform> poses;
  const auto collect = [&](Solver solver) {
    for (const PlanarTransform& pose : poses)
      if (std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.c) && std::isfinite(pose.s))
        hypotheses.push_back({pose, solver});
    poses.clear();
  };
  if (two) sampler.drawTwoDepth(of_two, random, poses);
  collect(Solver::two_depth);
  if (one) sampler.drawOnePointOneDepth(options.iterations - of_two, random, poses);
  collect(Solver::one_point_one_depth);
  return hypotheses;
}

/// Hypotheses that optimization takes to the same place, so that one of them is enough (m, rad).
bool alike(const Hypothesis& a, const Hypothesis& b) {
  constexpr double near = 0.02;
  return std::hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y) < near &&
         std::abs(a.pose.s * b.pose.c - a.pose.c * b.pose.s) < near && a.pose.c * b.pose.c + a.pose.s * b.pose.s > 0;
}

/// Log odds of the pose against chance: its likelihood ratio, integrated over the peak with a prior that spreads over
/// all headings and all places within sight of the references, when most images show a place of the map. The best of
/// many poses fits some outliers always; this asks for more.
double logEvidence(const RefinedPose& refined) {
  constexpr double reach = 10;  // m
  constexpr double odds_of_a_known_place = 20;
  const double volume = std::numbers::pi * reach * reach * 2 * std::numbers::pi;
  return refined.log_evidence - std::log(volume) + std::log(odds_of_a_known_place);
}

std::vector<PoseMode> refineModes(const PoseLikelihood& likelihood, const EstimatorOptions& options,
                                  const std::vector<ScoredHypothesis<Hypothesis>>& hypotheses) {
  const PoseRefiner refiner(likelihood, options.plane);
  std::vector<PoseMode> modes;
  for (const auto& [hypothesis, score] : hypotheses) {
    const RefinedPose refined = refiner.refine(hypothesis.pose);
    if (!refined.constrained || !(logEvidence(refined) > 0)) continue;
    PoseMode& mode = modes.emplace_back();
    mode.robot_in_map = refined.map_from_robot;
    mode.covariance = refined.covariance;
    mode.log_likelihood = refined.log_likelihood;
    mode.log_evidence = logEvidence(refined);
    mode.inliers = refiner.inliers(refined);
    mode.solver = hypothesis.solver;
  }
  return modes;
}

}  // namespace

PoseEstimate estimatePose(const PoseProblem& problem, const EstimatorOptions& options) {
  options.check();
  const PoseLikelihood likelihood(problem, options.likelihood);
  PoseEstimate estimate;
  const auto noPose = [&](const char* reason) {
    estimate.reason = reason;
    return estimate;
  };
  if (problem.matches.size() < 2) return noPose("fewer than two matches");
  const std::vector<Hypothesis> hypotheses = drawHypotheses(problem, options);
  if (hypotheses.empty()) return noPose("no sample gives a pose: too few matches with depth, or degenerate ones");

  const auto score = [&](std::span<const Hypothesis> all, std::span<double> scores) {
    std::vector<PlanarTransform> poses;
    for (const Hypothesis& hypothesis : all) poses.push_back(hypothesis.pose);
    likelihood.evaluate(poses, scores);
  };
  estimate.modes = mergeModes(
      refineModes(likelihood, options, bestHypotheses(hypotheses, options.refined, score, alike)), options.max_modes);
  if (!estimate.found()) estimate.reason = "no pose explains the matches better than chance";
  return estimate;
}

}  // namespace vmcl

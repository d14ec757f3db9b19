// SPDX-License-Identifier: BSD-3-Clause
#include "solution_trials.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>

#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mrpt/query_image.h"
#include "vmcl/study/confidence_interval.h"
#include "vmcl/study/pose_method.h"
#include "vmcl/study/sample_success.h"

namespace vmcl {
namespace {

constexpr std::array solvers{Solver::one_point_one_depth, Solver::two_depth};

/// The matches with one of the problem's references.
PoseProblem withReference(const PoseProblem& all, int reference) {
  PoseProblem problem{all.query_cameras, {all.reference_cameras[static_cast<std::size_t>(reference)]}, {}};
  for (Match match : all.matches) {
    if (match.reference_camera != reference) continue;
    match.reference_camera = 0;
    problem.matches.push_back(match);
  }
  return problem;
}

/// Share of inliers at the pose that all matches of the image give, among those with one reference; 0 without a pose.
double inlierRate(const PoseProblem& problem, const PoseEstimate& estimate, int reference) {
  int inliers = 0, matches = 0;
  for (const Match& match : problem.matches) matches += match.reference_camera == reference;
  if (estimate.found())
    for (const int inlier : estimate.modes.front().inliers)
      inliers += problem.matches[static_cast<std::size_t>(inlier)].reference_camera == reference;
  return matches == 0 ? 0 : static_cast<double>(inliers) / matches;
}

std::optional<PlanarPose> solve(const PoseProblem& problem, const Relocalizer& relocalizer, Solver solver,
                                Judge judge) {
  EstimatorOptions options = relocalizer.options().estimator;
  if (judge == Judge::likelihood) {
    options.solver = solver;
    const PoseEstimate estimate = estimatePose(problem, options);
    return estimate.found() ? std::optional(estimate.modes.front().robot_in_map) : std::nullopt;
  }
  static const std::vector<PoseMethod> methods = poseMethods();
  const char* name = solver == Solver::two_depth ? "2DP" : "1P1DP";
  const auto method = std::ranges::find(methods, name, &PoseMethod::name);
  const std::vector<PlanarPose> poses = method->estimate(problem, {.seed = options.seed});
  return poses.empty() ? std::nullopt : std::optional(poses.front());
}

}  // namespace

Solver SolutionTrial::better() const {
  constexpr double least_difference = 0.25, found_within = 1;  // m
  const double infinity = std::numeric_limits<double>::infinity();
  const double one = error[0].value_or(infinity), two = error[1].value_or(infinity);
  if (std::min(one, two) > found_within || !(std::abs(one - two) > least_difference)) return Solver::automatic;
  return one < two ? Solver::one_point_one_depth : Solver::two_depth;
}

std::vector<SolutionTrial> solutionTrials(const Relocalizer& relocalizer, std::span<const SolutionAnalysis> analyses,
                                          const CameraObservation& observation, const PlanarPose& truth, Judge judge) {
  constexpr int samples = 1000;
  const EstimatorOptions& options = relocalizer.options().estimator;
  const QueryImage query = queryImage(observation, relocalizer.map());
  const RelocalizationResult matched = relocalizer.match(std::span(&query, 1));
  const PoseEstimate estimate = estimatePose(matched.problem, options);
  std::vector<SolutionTrial> trials;
  for (std::size_t reference = 0; reference < matched.keyframes.size(); ++reference) {
    const PoseProblem problem = withReference(matched.problem, static_cast<int>(reference));
    if (problem.matches.empty()) continue;
    SolutionTrial trial{observation.time, observation.label, matched.keyframes[reference]};
    const SolutionAnalysis& analysis = analyses[static_cast<std::size_t>(trial.keyframe)];
    trial.matches = problem.matches.size();
    trial.with_depth = static_cast<std::size_t>(
        std::ranges::count_if(problem.matches, [](const Match& match) { return match.point.has_value(); }));
    const double inlier_rate = inlierRate(matched.problem, estimate, static_cast<int>(reference));
    trial.rates = {inlier_rate, inlier_rate, analysis.rates.reliable_depth};
    for (std::size_t i = 0; i < solvers.size(); ++i) {
      const SampleWorth& worth = i == 0 ? analysis.one_point_one_depth : analysis.two_depth;
      trial.predicted[i] = chanceOfGoodSample(solvers[i], trial.rates) * worth.chance_within;
      trial.observed[i] = sampleSuccess(solvers[i], problem, truth, samples, options.seed);
      const auto pose = solve(problem, relocalizer, solvers[i], judge);
      if (pose) trial.error[i] = std::hypot(pose->x - truth.x, pose->y - truth.y);
    }
    trials.push_back(std::move(trial));
  }
  return trials;
}

std::vector<Solver> labelsOf(std::span<const SolutionTrial> trials, std::size_t keyframes) {
  std::vector<SolutionVotes> votes(keyframes);
  for (const SolutionTrial& trial : trials) votes[static_cast<std::size_t>(trial.keyframe)].add(trial.better());
  std::vector<Solver> labels;
  for (const SolutionVotes& of_keyframe : votes) labels.push_back(of_keyframe.winner());
  return labels;
}

void writeTrials(const std::filesystem::path& file, std::span<const SolutionTrial> trials) {
  AtomicFile output(file);
  std::ostream& out = output.stream();
  out << "time,camera,keyframe,matches,with_depth,inlier_rate,reliable_depth,predicted_1p1dp,"
         "predicted_2dp,observed_1p1dp,observed_2dp,error_1p1dp,error_2dp,better\n"
      << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const SolutionTrial& trial : trials) {
    out << trial.time << ',' << trial.label << ',' << trial.keyframe << ',' << trial.matches << ',' << trial.with_depth
        << ',' << trial.rates.sparse_inliers << ',' << trial.rates.reliable_depth;
    for (const OfBothSolutions& chances : {trial.predicted, trial.observed})
      for (const double chance : chances) out << ',' << chance;
    for (const std::optional<double>& error : trial.error) {
      out << ',';
      if (error) out << *error;
    }
    const Solver better = trial.better();
    out << ',' << (better == Solver::automatic ? "" : nameOf(better)) << '\n';
  }
  output.commit();
}

void printCalibration(std::span<const SolutionTrial> trials) {
  constexpr std::array<double, 8> bounds{0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 1.01};
  std::cout << "chance that a sample leads to within 0.25 m and 5 deg\n"
               "solution  predicted       problems   predicted    observed  95 % interval\n"
            << std::fixed << std::setprecision(3);
  for (std::size_t solution = 0; solution < solvers.size(); ++solution) {
    for (std::size_t bin = 0; bin + 1 < bounds.size(); ++bin) {
      std::vector<double> predicted, observed;
      for (const SolutionTrial& trial : trials) {
        const double chance = trial.predicted[solution];
        if (!(chance >= bounds[bin] && chance < bounds[bin + 1])) continue;
        predicted.push_back(chance);
        observed.push_back(trial.observed[solution]);
      }
      if (observed.empty()) continue;
      const Interval interval = bootstrapMean(observed);
      std::cout << std::left << std::setw(10) << nameOf(solvers[solution]) << std::right << std::setw(5) << bounds[bin]
                << " to " << std::min(1.0, bounds[bin + 1]) << std::setw(9) << observed.size() << std::setw(12)
                << mean(predicted) << std::setw(12) << mean(observed) << "  " << interval.low << " to " << interval.high
                << '\n';
    }
  }
}

}  // namespace vmcl

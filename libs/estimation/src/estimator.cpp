// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "best_distinct.h"
#include "sample_search.h"
#include "spatial_search.h"

namespace vmcl {

void EstimatorOptions::check() const {
  const auto positive = [](const char* key, int value) {
    if (value < 1) throw std::invalid_argument(std::string(key) + " must be at least 1, not " + std::to_string(value));
  };
  positive("iterations", iterations);
  positive("refined", refined);
  positive("max_modes", max_modes);
  if (!std::isfinite(in_sight_log_odds)) throw std::invalid_argument("in_sight_log_odds must be finite");
  if (motion != Motion::planar && solver != Solver::automatic)
    throw std::invalid_argument("solver must be auto where motion is not planar, not " + std::string(nameOf(solver)));
  if (solver == Solver::three_depth) throw std::invalid_argument("solver 3dp is for free motion: leave solver auto");
  likelihood.check();
  plane.check();
}

namespace {

constexpr double within_sight = 10;  // m; most of what a reference sees is nearer

/// Log odds of the pose against chance: its likelihood ratio, integrated over the peak with a prior that spreads over
/// all headings and all places within sight of the references.
double logEvidence(const RefinedPose& refined) {
  const double volume = std::numbers::pi * within_sight * within_sight * 2 * std::numbers::pi;
  return refined.log_evidence - std::log(volume);
}

/// Whether the robot is rather here than nowhere. The best of many poses always fits some outliers, and a share of
/// inliers fitted to them makes much of it: so believe in one other than the options' only if the evidence is strong.
bool isBetterThanChance(const RefinedPose& refined, const PoseLikelihood& as_expected, double in_sight_log_odds) {
  constexpr double log_odds_of_another_share = -5;
  const double expected = logEvidence(refined) - refined.log_likelihood + as_expected(refined.rigid());
  return std::max(expected, logEvidence(refined) + log_odds_of_another_share) + in_sight_log_odds > 0;
}

/// A pose to be refined, or refined, and the kind of the sample that led to it.
struct RefinedHypothesis {
  RefinedPose pose;
  Solver solver;
};

/// Whether the matches say where the robot is, and that is within sight of what a reference may see.
bool isPlace(const RefinedPose& pose, const PoseProblem& problem) {
  constexpr double farthest = 10 * within_sight;
  const Eigen::Vector2d place(pose.map_from_robot.x, pose.map_from_robot.y);
  return pose.constrained && pose.covariance.topLeftCorner<2, 2>().trace() < within_sight * within_sight &&
         std::ranges::any_of(problem.reference_cameras, [&](const ReferenceCamera& reference) {
           return (reference.map_from_camera.translation().head<2>() - place).norm() < farthest;
         });
}

/// Each optimized, those without a place dropped, the heaviest first, and of those that ended at one peak the first.
std::vector<RefinedHypothesis> refined(const PoseProblem& problem, const PoseRefiner& refiner,
                                       const std::vector<RefinedHypothesis>& hypotheses) {
  std::vector<RefinedHypothesis> all;
  std::vector<double> evidence;
  for (const auto& [pose, solver] : hypotheses) {
    const RefinedPose peak = refiner.refine(pose);
    if (!isPlace(peak, problem)) continue;
    all.push_back({peak, solver});
    evidence.push_back(peak.log_evidence);
  }
  const auto is_same = [&](std::size_t a, std::size_t b) {
    return (all[a].pose.rigid().matrix() - all[b].pose.rigid().matrix()).cwiseAbs().maxCoeff() < 1e-4;
  };
  std::vector<RefinedHypothesis> kept;
  for (const std::size_t i : bestDistinct(evidence, all.size(), is_same)) kept.push_back(all[i]);
  return kept;
}

bool fixesThePose(const PlanarSlope& slope) {
  constexpr double least = 1e-9;  // of the determinant of the information scaled to a unit diagonal
  return slope.information.determinant() > least * slope.information.diagonal().prod();
}

/// Log likelihood below the best that refinement on the plane does not make up for. Off it, the true pose may look
/// poor.
double hopelessBelow(const SoftPlane& plane) {
  const bool is_soft = plane.sigma_tilt > 0 || plane.sigma_height > 0;
  return is_soft ? std::numeric_limits<double>::infinity() : 25;
}

/// The peaks above the hypotheses, the highest first, without those whose log likelihood is `hopeless` below the best.
std::vector<RefinedHypothesis> summitsAbove(const PoseRefiner& climber, const std::vector<Hypothesis>& starts,
                                            double hopeless) {
  std::vector<PlanarTransform> poses;
  for (const Hypothesis& start : starts) poses.push_back(start.pose);
  const std::vector<ClimbedPose> climbed = climber.climb(poses);
  double best = -std::numeric_limits<double>::infinity();
  for (const ClimbedPose& one : climbed)
    if (fixesThePose(one.slope)) best = std::max(best, one.slope.log_likelihood);
  std::vector<RefinedHypothesis> summits;
  for (const auto& [pose, slope, start] : climbed)
    if (slope.log_likelihood >= best - hopeless)
      summits.push_back({RefinedPose::at(pose.rigid()), starts[static_cast<std::size_t>(start)].solver});
  return summits;
}

/// What the motion leaves free.
SoftPlane softPlane(const EstimatorOptions& options) {
  constexpr double any_tilt = 1, any_height = 10;
  SoftPlane plane = options.plane;
  if (options.motion == Motion::free) plane.sigma_tilt = any_tilt;
  if (options.motion != Motion::planar) plane.sigma_height = std::max(plane.sigma_height, any_height);
  return plane;
}

/// Poses to be refined, the best first; nothing if no sample can be drawn.
std::optional<std::vector<RefinedHypothesis>> search(const PoseProblem& problem, const PoseLikelihood& likelihood,
                                                     const EstimatorOptions& options) {
  if (options.motion == Motion::planar) {
    const auto starts = searchSamples(problem, likelihood, options);
    if (!starts) return std::nullopt;
    return summitsAbove(PoseRefiner(likelihood, {}), *starts, hopelessBelow(options.plane));
  }
  const auto starts = searchSpatialSamples(problem, likelihood, options);
  if (!starts) return std::nullopt;
  std::vector<RefinedHypothesis> found;
  for (const auto& [pose, solver] : *starts) found.push_back({RefinedPose::at(pose), solver});
  return found;
}

/// A likelihood to judge and optimize all poses with.
struct ShownLikelihood {
  PoseLikelihood likelihood;
  double spread = 1;  ///< of covariances: where the noise is estimated, errors are Student's
};

/// With the share of inliers and, unless it is known, the pixel noise that show at the peak above the best pose, which
/// is moved there.
ShownLikelihood asShownBy(RefinedPose& best, const PoseLikelihood& first_guess, const EstimatorOptions& options) {
  constexpr int max_rounds = 6;
  constexpr double settled = 0.1;  // change of the noise, relative
  const LikelihoodOptions& prior = options.likelihood;
  std::optional<PoseLikelihood> likelihood;
  double sigma_px = prior.sigma_px, change = 1, spread = 1;
  for (int round = 0; round < max_rounds && change > settled; ++round) {
    const PoseRefiner refiner(likelihood ? *likelihood : first_guess, softPlane(options));
    best = refiner.refine(best);
    const double inlier_rate = refiner.inlierRate(best, prior.inlier_prior);
    change = 0;
    if (options.estimate_sigma_px) {
      const auto [estimated, freedom] = refiner.pixelNoise(best, inlier_rate, prior.sigma_px);
      change = std::abs(std::log(estimated / sigma_px));
      sigma_px = estimated;
      spread = freedom / (freedom - 2);
    }
    likelihood = first_guess.with(inlier_rate, sigma_px);
  }
  return {*std::move(likelihood), spread};
}

double offPlaneLogOdds(const PoseLikelihood& likelihood, const RefinedPose& refined) {
  const RefinedPose off =
      PoseRefiner(likelihood, {.sigma_tilt = 0.1, .sigma_height = 0.2}).refine(PlanarTransform(refined.map_from_robot));
  return off.constrained ? off.log_evidence - refined.log_evidence : 0;
}

PoseEstimate noPose(NoPose failure) {
  PoseEstimate estimate;
  estimate.failure = failure;
  switch (failure) {
    case NoPose::none:
      break;
    case NoPose::too_few_matches:
      estimate.reason = "fewer matches than a sample needs";
      break;
    case NoPose::no_sample:
      estimate.reason = "no sample gives a pose: too few matches with depth, or degenerate ones";
      break;
    case NoPose::unconstrained:
      estimate.reason = "the matches do not fix the pose";
      break;
    case NoPose::no_better_than_chance:
      estimate.reason = "no pose explains the matches better than chance";
      break;
  }
  return estimate;
}

}  // namespace

std::string_view nameOf(NoPose failure) {
  switch (failure) {
    case NoPose::none:
      break;
    case NoPose::too_few_matches:
      return "too_few_matches";
    case NoPose::no_sample:
      return "no_sample";
    case NoPose::unconstrained:
      return "unconstrained";
    case NoPose::no_better_than_chance:
      return "no_better_than_chance";
  }
  return "";
}

PoseEstimate estimatePose(const PoseProblem& problem, const EstimatorOptions& options) {
  options.check();
  const PoseLikelihood first_guess(problem, options.likelihood);
  std::optional<std::vector<RefinedHypothesis>> found = search(problem, first_guess, options);
  if (!found) return noPose(problem.matches.size() < 2 ? NoPose::too_few_matches : NoPose::no_sample);
  if (found->empty()) return noPose(NoPose::no_sample);

  const auto [likelihood, spread] = asShownBy(found->front().pose, first_guess, options);
  const PoseRefiner refiner(likelihood, softPlane(options));
  std::vector<RefinedHypothesis> peaks = refined(problem, refiner, *found);
  if (peaks.empty()) return noPose(NoPose::unconstrained);
  std::erase_if(peaks, [&](const RefinedHypothesis& peak) {
    return !isBetterThanChance(peak.pose, first_guess, options.in_sight_log_odds);
  });
  if (peaks.empty()) return noPose(NoPose::no_better_than_chance);
  PoseEstimate estimate;
  for (const auto& [pose, solver] : peaks)
    estimate.modes.push_back({pose.map_from_robot, pose.roll, pose.pitch, pose.height, spread * pose.covariance,
                              pose.log_likelihood, logEvidence(pose), 0, refiner.inliers(pose), solver});
  estimate.modes = mergeModes(std::move(estimate.modes), options.max_modes);
  estimate.inlier_rate = likelihood.options().inlier_prior;
  estimate.sigma_px = likelihood.options().sigma_px;
  const PoseMode& best = estimate.modes.front();
  if (options.motion != Motion::planar) return estimate;
  estimate.degeneracies = degeneracies(problem, best.inliers, best.robot_in_map, estimate.sigma_px);
  const auto heaviest = std::ranges::find(peaks, best.log_likelihood,
                                          [](const RefinedHypothesis& peak) { return peak.pose.log_likelihood; });
  estimate.off_plane_log_odds = offPlaneLogOdds(likelihood, heaviest->pose);
  return estimate;
}

}  // namespace vmcl

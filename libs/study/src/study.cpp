// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/study.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/pose_refiner.h"
#include "vmcl/study/cramer_rao_bound.h"

namespace vmcl {
namespace {

constexpr double min_sigma_px = 0.5;      // methods are told no less: no camera is better
constexpr double no_noise_px = 1e-3;      // stands for none, with which the Cramer-Rao bound has no value
constexpr double threshold_in_sigma = 4;  // tighter ones serve no method better: points are off as well

std::vector<StudyCell> allCells() {
  std::vector<StudyCell> cells;
  const auto add = [&](Figure figure, const WorldSettings& world) {
    cells.push_back({figure, static_cast<int>(cells.size()), world});
  };
  for (const int cameras : {1, 3})
    for (const double noise_px : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0})
      add(Figure::accuracy, {World::paper, cameras, 50, 0, 1, noise_px});
  for (const World world : {World::paper, World::authors, World::uniform})
    for (const int cameras : {1, 3})
      for (const double outlier_rate : {0.5, 0.6, 0.7, 0.8})
        for (const double depth_rate : {0.5, 0.3, 0.1})
          add(Figure::success, {world, cameras, 50, outlier_rate, depth_rate, 2});
  for (const int matches : {50, 100, 200, 500, 1000, 2000, 5000, 10000})
    add(Figure::cost_of_matches, {World::paper, 1, matches, 0.5, 0.5, 2});
  for (const int cameras : {1, 2, 3, 4, 5, 6}) add(Figure::cost_of_cameras, {World::paper, cameras, 50, 0.5, 0.5, 2});
  for (const World world : {World::paper, World::authors})
    for (const double tilt_deg : {0.0, 0.25, 0.5, 0.75, 1.0})
      add(Figure::tilt, {world, 1, 50, 0.3, 0.5, 2, tilt_deg * degree});
  return cells;
}

/// What the answers to a problem are compared with.
struct Truth {
  PlanarPose map_from_robot;
  Eigen::Matrix3d information;  ///< Fisher's

  EstimationError errorOf(const PlanarPose& pose) const {
    const Eigen::Vector3d error(pose.x - map_from_robot.x, pose.y - map_from_robot.y,
                                wrapAngle(pose.phi - map_from_robot.phi));
    return {error.head<2>().norm(), std::abs(error.z()), error.dot(information * error)};
  }
};

/// Processor time of this thread: other work on the machine does not count.
double threadSeconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Estimate>
MethodOutcome outcomeOf(const Truth& truth, const Estimate& estimate) {
  const double start = threadSeconds();
  const std::vector<PlanarPose> poses = estimate();
  MethodOutcome outcome;
  outcome.seconds = threadSeconds() - start;
  if (!poses.empty()) outcome.error = truth.errorOf(poses.front());
  outcome.any_success =
      std::any_of(poses.begin(), poses.end(), [&](const PlanarPose& pose) { return truth.errorOf(pose).isSuccess(); });
  return outcome;
}

std::vector<PlanarPose> optimizedFromTruth(const SimulatedProblem& simulated, const MethodSettings& settings) {
  LikelihoodOptions options;
  options.sigma_px = settings.sigma_px;
  const PoseLikelihood likelihood(simulated.problem, options);
  return {PoseRefiner(likelihood, {}).refine(PlanarTransform(simulated.map_from_robot)).map_from_robot};
}

std::optional<EstimationError> cramerRaoErrors(const SimulatedProblem& simulated, double noise_px) {
  const auto covariance = cramerRaoBound(simulated, noise_px);
  if (!covariance) return std::nullopt;
  return EstimationError{std::sqrt(covariance->topLeftCorner<2, 2>().trace()), std::sqrt((*covariance)(2, 2)), 3};
}

}  // namespace

std::string_view nameOf(Figure figure) {
  switch (figure) {
    case Figure::accuracy:
      return "accuracy";
    case Figure::success:
      return "success";
    case Figure::tilt:
      return "tilt";
    case Figure::cost_of_matches:
      return "cost-matches";
    case Figure::cost_of_cameras:
      return "cost-cameras";
  }
  throw std::invalid_argument("no such figure");
}

std::vector<StudyCell> studyCells(const std::vector<Figure>& figures) {
  std::vector<StudyCell> cells = allCells();
  std::erase_if(cells, [&](const StudyCell& cell) {
    return std::find(figures.begin(), figures.end(), cell.figure) == figures.end();
  });
  return cells;
}

std::vector<PoseMethod> methodsOf(const StudyCell& cell) {
  std::vector<PoseMethod> methods = poseMethods();
  if (cell.world.cameras > 1 || cell.figure == Figure::cost_of_cameras)
    std::erase_if(methods, [](const PoseMethod& method) { return !method.takes_rigs; });
  if (cell.figure == Figure::tilt) methods.insert(methods.begin() + 1, softPlaneMethod());
  return methods;
}

MethodSettings settingsOf(const StudyCell& cell, int trial) {
  MethodSettings settings;
  settings.sigma_px = std::max(cell.world.noise_px, min_sigma_px);
  settings.threshold_px = threshold_in_sigma * std::max(cell.world.noise_px, 2.0);
  settings.seed = static_cast<uint64_t>(trial) + 1;
  return settings;
}

TrialResult runTrial(const StudyCell& cell, const std::vector<PoseMethod>& methods, uint64_t seed, int trial) {
  Random random(seed, static_cast<uint64_t>(cell.number) << 32 | static_cast<uint64_t>(trial));
  const SimulatedProblem simulated = simulateProblem(cell.world, random);
  const MethodSettings settings = settingsOf(cell, trial);
  const double bound_noise_px = std::max(cell.world.noise_px, no_noise_px);
  const Truth truth{simulated.map_from_robot, fisherInformation(simulated, bound_noise_px)};
  TrialResult result;
  for (const PoseMethod& method : methods)
    result.outcomes.push_back(outcomeOf(truth, [&] { return method.estimate(simulated.problem, settings); }));
  result.outcomes.push_back(outcomeOf(truth, [&] { return optimizedFromTruth(simulated, settings); }));
  result.cramer_rao = cramerRaoErrors(simulated, bound_noise_px);
  return result;
}

}  // namespace vmcl

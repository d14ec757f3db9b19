// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <iostream>
#include <map>
#include <string>

#include "choice_option.h"
#include "estimation_json.h"
#include "ordered_parallel.h"
#include "verbs.h"
#include "vmcl/estimation/estimator.h"

namespace vmcl {
namespace {

struct EstimateOptions {
  EstimatorOptions estimator;
  int threads = 1;
  bool time = false;
};

struct Answer {
  std::string line;
  std::string complaint;  ///< empty when the problem was well formed
  std::size_t number = 0;
  std::set<std::string> unknown_keys;
};

/// Names each unknown key once.
class UnknownKeys {
 public:
  bool any() const { return !named_.empty(); }

  void name(const Answer& answer) {
    for (const std::string& key : answer.unknown_keys)
      if (named_.insert(key).second)
        std::cerr << "vmcl estimate: <stdin> line " << answer.number << ": unknown key \"" << key
                  << "\" is passed over, here and below\n";
  }

 private:
  std::set<std::string> named_;
};

Answer answer(const std::string& line, std::size_t number, const EstimateOptions& options) {
  std::string id;
  try {
    const IdentifiedProblem identified = parseProblem(line, id);
    const auto start = std::chrono::steady_clock::now();
    const PoseEstimate estimate = estimatePose(identified.problem, options.estimator);
    const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - start;
    return {formatEstimate(id, estimate, options.time ? std::optional(elapsed.count()) : std::nullopt), "", number,
            identified.unknown_keys};
  } catch (const std::exception& error) {
    return {formatError(id, error.what()), "line " + std::to_string(number) + ": " + error.what(), number, {}};
  }
}

int run(const EstimateOptions& options) {
  options.estimator.check();
  std::ios::sync_with_stdio(false);  // halves the time to read
  std::size_t problems = 0, bad = 0;
  UnknownKeys unknown_keys;
  std::string line;
  std::size_t number = 0;
  const auto next = [&](std::pair<std::string, std::size_t>& job) {
    while (std::getline(std::cin, line)) {
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      job = {line, number};
      return true;
    }
    return false;
  };
  const auto work = [&](const std::pair<std::string, std::size_t>& job) {
    return answer(job.first, job.second, options);
  };
  const auto write = [&](const Answer& done) {
    ++problems;
    std::cout << done.line << '\n';
    unknown_keys.name(done);
    if (done.complaint.empty()) return;
    ++bad;
    std::cerr << "vmcl estimate: <stdin> " << done.complaint << '\n';
  };
  orderedParallel<std::pair<std::string, std::size_t>, Answer>(options.threads, next, work, write);
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("<stdout>: cannot be written");
  if (problems == 0) throw std::runtime_error("<stdin>: no problem, expected one JSON object a line");
  if (bad == problems) return exit_failed;
  return bad == 0 && !unknown_keys.any() ? exit_done : exit_some_input_bad;
}

}  // namespace

void addEstimateVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EstimateOptions>();
  CLI::App* verb = app.add_subcommand("estimate", "Estimate poses from matches: JSON Lines in, JSON Lines out");
  static const std::map<std::string, Solver> solvers{{"auto", Solver::automatic},
                                                     {"1p1dp", Solver::one_point_one_depth},
                                                     {"2dp", Solver::two_depth},
                                                     {"3p", Solver::three_rays},
                                                     {"3b", Solver::three_bearings}};
  addChoice(*verb, "--solver", options->estimator.solver, solvers, "kind of samples drawn")->default_str("auto");
  static const std::map<std::string, Motion> motions{
      {"planar", Motion::planar}, {"upright", Motion::upright}, {"free", Motion::free}};
  addChoice(*verb, "--motion", options->estimator.motion, motions,
            "how the robot may stand: on the ground, at any height, anyhow")
      ->default_str("planar");
  verb->add_option("--iterations", options->estimator.iterations, "most samples drawn")->capture_default_str();
  verb->add_option("--seed", options->estimator.seed, "same seed, same answers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  EstimatorOptions& estimator = options->estimator;
  estimator.estimate_sigma_px = true;
  const auto setSigma = [&estimator](double sigma_px) {
    estimator.likelihood.sigma_px = sigma_px;
    estimator.estimate_sigma_px = false;
  };
  verb->add_option_function<double>("--sigma-px", setSigma,
                                    "standard deviation of a pixel coordinate; estimated where it is not given");
  const auto inDegrees = [](double& radians) { return [&radians](double degrees) { radians = degrees * degree; }; };
  verb->add_option_function<double>("--sigma-tilt-deg", inDegrees(options->estimator.plane.sigma_tilt),
                                    "standard deviation of the robot's roll and pitch; 0: it stands upright")
      ->default_str("0");
  verb->add_option("--sigma-height", options->estimator.plane.sigma_height,
                   "standard deviation of its height over the plane, m; 0: it stands on it")
      ->capture_default_str();
  verb->add_option("--threads", options->threads, "problems worked on at once; the answers do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->add_flag("--time", options->time, "add time_us to each answer: the one field that differs from run to run");
  verb->footer(
      "Example: vmcl estimate --seed 7 < problems.jsonl > answers.jsonl\n"
      "A line is one problem: query_cameras, reference_cameras and matches; an answer has the same id.");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>
#include <memory>

#include "problem_report.h"
#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/evaluation/localization_picture.h"
#include "vmcl/evaluation/localization_report.h"
#include "vmcl/mrpt/error_message.h"

namespace vmcl {
namespace {

struct Request {
  std::filesystem::path config;
  std::vector<std::filesystem::path> maps;
  std::filesystem::path rawlog;
  std::filesystem::path out;
  std::filesystem::path ground_truth;
  uint64_t seed = 1;
  int threads = 1;
};

/// Runs through the log; returns what was wrong with it.
ProblemReport replay(Localizer& localizer, const std::filesystem::path& rawlog, LocalizationRun& run) {
  ProblemReport problems;
  RawlogReader reader(rawlog);
  ProgressBar bar;
  RawlogEntry entry;
  try {
    while (reader.next(entry)) {
      bar.update("localizing", reader.progress());
      if (const auto frame = localizer.step(entry.action, entry.frame, entry.observation)) run.frames.push_back(*frame);
      for (const std::string& problem : localizer.takeProblems()) problems.add(rawlog.string() + ": " + problem);
    }
  } catch (const std::runtime_error& error) {
    if (run.frames.empty()) throw;
    problems.add(errorMessage(error));
  }
  return problems;
}

void printSummary(const LocalizationRun& run) {
  std::cout << std::fixed << std::setprecision(3);
  const auto first =
      std::find_if(run.frames.begin(), run.frames.end(), [](const LocalizationFrame& f) { return f.localized; });
  const LocalizationFrame& last = run.frames.back();
  std::cout << run.frames.size() << " updates";
  if (first == run.frames.end()) {
    std::cout << ", never localized\n";
  } else {
    const PlanarPose& pose = last.cluster.robot_in_map;
    std::cout << ", localized first after " << first->time - run.frames.front().time << " s\nat the end "
              << (last.localized ? "localized" : "not localized") << " at x " << pose.x << " m, y " << pose.y
              << " m, heading " << pose.phi / degree << " deg (deviation " << last.cluster.positionDeviation() << " m, "
              << last.cluster.headingDeviation() / degree << " deg)\n";
  }
  if (!run.ground_truth) return;
  const TrajectoryEvaluation evaluation = evaluateTrajectory(estimatesOf(run.frames), *run.ground_truth);
  if (evaluation.compared == 0) std::cout << "the ground truth covers no update\n";
  if (evaluation.compared > 0 && !evaluation.time_to_converge) std::cout << "never converged to the ground truth\n";
  if (evaluation.time_to_converge)
    std::cout << "converged after " << *evaluation.time_to_converge << " s, from then on RMSE "
              << evaluation.position_after.rmse << " m, " << evaluation.heading_after.rmse / degree
              << " deg; false accepts " << evaluation.false_accepts << '\n';
}

void writeAll(const std::filesystem::path& directory, const LocalizationRun& run, const Localizer& localizer) {
  std::filesystem::create_directories(directory);
  writeTrajectory(directory / "trajectory.tum", run.frames);
  writeFrames(directory / "frames.csv", run.frames);
  writeTiming(directory / "timing.csv", run.frames);
  writeSummary(directory / "summary.json", run);
  writeScene(directory / "scene.3Dscene", run, localizer);
  drawPath(directory / "path", run, localizer.maps());
}

int localize(const Request& request) {
  LocalizationConfig config = loadLocalizationConfig(request.config, request.maps, request.rawlog);
  config.monte_carlo.seed = request.seed;
  config.monte_carlo.threads = request.threads;
  LocalizationRun run;
  if (!request.ground_truth.empty()) run.ground_truth = readTumTrajectory(request.ground_truth);
  Localizer localizer(config, loadMaps(config));
  const ProblemReport problems = replay(localizer, config.rawlog_file, run);
  if (run.frames.empty())
    throw std::runtime_error(problems.empty()
                                 ? config.rawlog_file.string() + ": no observation that the configured maps can use"
                                 : problems.inOneLine());
  problems.print("localize");
  printSummary(run);
  if (!request.out.empty()) writeAll(request.out, run, localizer);
  return problems.empty() ? exit_done : exit_some_input_bad;
}

}  // namespace

void addLocalizeVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("localize", "Localize the robot of a rawlog in a map with a particle filter.");
  const auto request = std::make_shared<Request>();
  verb->add_option("config", request->config, "Experiment, an ini of pf-localization")->required();
  verb->add_option("--rawlog", request->rawlog, "Log to localize, instead of the ini's rawlog_file");
  verb->add_option("--map", request->maps, "Map instead of the ini's: .vmap, .simplemap or .gridmap; may be repeated");
  verb->add_option("--out", request->out,
                   "Directory for trajectory.tum, frames.csv, summary.json, scene.3Dscene, path.svg, path.png and "
                   "timing.csv (the only one that differs between runs of one seed)");
  verb->add_option("--groundtruth", request->ground_truth, "True poses in the map, TUM format, to compare with");
  verb->add_option("--seed", request->seed, "Of everything random: same seed, same results")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--threads", request->threads, "That weigh particles; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->footer(
      "Example:\n"
      "  vmcl localize share/config/camera.ini --map rooms.vmap --rawlog query.rawlog --out result\n"
      "Needs no display. Windows, repetitions and stock output files that the ini asks for are left out.");
  verb->callback([request, &exit_code] { exit_code = localize(*request); });
}

}  // namespace vmcl

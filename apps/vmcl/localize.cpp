// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>

#include "choice_option.h"
#include "coverage.h"
#include "health_report.h"
#include "problem_report.h"
#include "replay.h"
#include "verbs.h"
#include "vmcl/evaluation/localization_picture.h"
#include "vmcl/evaluation/localization_report.h"

namespace vmcl {
namespace {

struct Request {
  std::filesystem::path config;
  IniChanges changes;
  std::vector<std::filesystem::path> maps;
  std::filesystem::path rawlog;
  std::filesystem::path out;
  std::filesystem::path ground_truth;
  std::string start;
  std::filesystem::path initial_pose;
  std::vector<double> kidnapping;  ///< at, skip; or empty
  double skipped = 0;
  Disturbance disturbance{};
  std::vector<double> dimming;  ///< at, for, light; or empty
  uint64_t seed = 1;
  int threads = 1;
  bool tables_only = false;
};

/// Made before the work, so that a bad place is told at once; taken back when nothing was written.
class OutputDirectory {
 public:
  explicit OutputDirectory(std::filesystem::path directory) {
    if (directory.empty()) return;
    directory = std::filesystem::absolute(directory);
    for (auto part = directory; !std::filesystem::exists(part); part = part.parent_path()) made_.push_back(part);
    std::filesystem::create_directories(directory);
  }
  ~OutputDirectory() {
    std::error_code not_empty;
    for (const auto& part : made_) std::filesystem::remove(part, not_empty);
  }
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< innermost first
};

/// The robot stands about where it truly is when the log begins, as when a user says where.
void startNearTruth(const Trajectory& ground_truth, LocalizationConfig& config, Replay& replay) {
  constexpr double reach = 0.2, turn = 10 * degree;
  replay.begin = firstCoveredTime(replay.rawlog, ground_truth, replay.skipped);
  const PlanarPose pose = planarPart(*ground_truth.at(replay.begin));
  config.start = {pose.x - reach, pose.x + reach, pose.y - reach, pose.y + reach, pose.phi - turn, pose.phi + turn};
  config.start_in_free_space = false;
}

/// Says when the ini's map is used beside those of the command line: one of them for the laser, one for the camera.
void printMaps(const Request& request, const LocalizationConfig& config) {
  const auto& given = request.maps;
  if (!given.empty() && !config.map_file.empty() &&
      std::find(given.begin(), given.end(), config.map_file) == given.end())
    std::cout << "beside --map also the ini's map_file is used: " << config.map_file.string() << '\n';
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
  if (evaluation.compared > 0 && !evaluation.time_to_converge) std::cout << "never converged to the ground truth\n";
  if (evaluation.time_to_converge)
    std::cout << "converged after " << *evaluation.time_to_converge << " s, from then on RMSE "
              << evaluation.position_after.rmse << " m, " << evaluation.heading_after.rmse / degree
              << " deg; false accepts " << evaluation.false_accepts << '\n';
}

void writeAll(const std::filesystem::path& directory, bool tables_only, const LocalizationRun& run,
              const Localizer& localizer) {
  writeTrajectory(directory / "trajectory.tum", run.frames);
  writeFrames(directory / "frames.csv", run.frames);
  writeTiming(directory / "timing.csv", run.frames);
  writeSummary(directory / "summary.json", run);
  writeHealth(directory / "health.csv", run.frames);
  writeHealthSummary(directory / "health.json", run.frames);
  std::filesystem::remove(directory / "pose.yaml");  // of an earlier run
  if (run.frames.back().localized) savePose(directory / "pose.yaml", localizer.estimate());
  if (tables_only) return;
  writeScene(directory / "scene.3Dscene", run, localizer);
  drawPath(directory / "path", run, localizer.maps());
}

Disturbance disturbanceOf(const Request& request) try {
  Disturbance disturbance = request.disturbance;
  if (const auto& dim = request.dimming; !dim.empty()) disturbance.dimming = {dim[0], dim[1], dim[2]};
  disturbance.check();
  return disturbance;
} catch (const std::invalid_argument& error) {
  throw CLI::ValidationError(error.what());
}

int localize(const Request& request) {
  if (request.start == "given" && request.ground_truth.empty())
    throw CLI::RequiresError("--start given", "--groundtruth");
  const Disturbance disturbance = disturbanceOf(request);
  LocalizationConfig config = loadLocalizationConfig(request.config, request.maps, request.rawlog, request.changes);
  config.monte_carlo.seed = request.seed;
  config.monte_carlo.threads = request.threads;
  if (!request.start.empty()) {
    config.start_anywhere = request.start == "global";
    config.initial_pose.reset();
  }
  if (!request.initial_pose.empty()) config.initial_pose = loadPose(request.initial_pose);
  LocalizationRun run;
  if (!request.ground_truth.empty()) run.ground_truth = readTumTrajectory(request.ground_truth);
  Replay plan;
  plan.rawlog = config.rawlog_file;
  plan.skipped = request.skipped;
  plan.disturbance = disturbance;
  plan.seed = request.seed;
  if (!request.kidnapping.empty()) plan.kidnapping = {request.kidnapping[0], request.kidnapping[1]};
  if (request.start == "given") startNearTruth(*run.ground_truth, config, plan);
  Localizer localizer(config, loadMaps(config));
  const OutputDirectory out(request.out);
  std::cout << "localizing " << config.rawlog_file.string() << std::endl;
  ProblemReport problems = replay(plan, localizer, run);
  if (run.frames.empty())
    throw std::runtime_error(problems.empty()
                                 ? config.rawlog_file.string() + ": no observation that the configured maps can use" +
                                       (request.skipped > 0 ? " after what --skip leaves out" : "")
                                 : problems.inOneLine());
  const std::vector<TimedEstimate> estimates = estimatesOf(run.frames);
  if (run.ground_truth && evaluateTrajectory(estimates, *run.ground_truth).compared == 0)
    problems.add(request.ground_truth.string() + ": " +
                 coversNothing(*run.ground_truth, estimates.front().time, estimates.back().time));
  problems.print("localize");
  printMaps(request, config);
  printSummary(run);
  printHealth(std::cout, run.frames);
  if (!request.out.empty()) writeAll(request.out, request.tables_only, run, localizer);
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
                   "Directory for trajectory.tum, frames.csv, summary.json, health.csv, health.json, pose.yaml, "
                   "scene.3Dscene, path.svg, path.png and "
                   "timing.csv (the only one that differs between runs of one seed)");
  verb->add_flag("--tables-only", request->tables_only, "Leave out scene and pictures");
  verb->add_option("--groundtruth", request->ground_truth, "True poses in the map, TUM format, to compare with");
  verb->add_option("--set", request->changes.values, "SECTION.KEY=VALUE instead of the ini's; may be repeated");
  static const std::map<std::string, Sensors> sensors(sensors_by_name.begin(), sensors_by_name.end());
  addChoice(*verb, "--sensors", request->changes.sensors, sensors,
            "Use only the maps of these: both needs some of each, odometry uses none");
  verb->add_option(
          "--start", request->start,
          "Instead of the ini's: global (anywhere in the maps) or given (within 0.2 m and 10 deg of the ground "
          "truth, when it sets in)")
      ->check(CLI::IsMember({"global", "given"}));
  verb->add_option("--initial-pose", request->initial_pose,
                   "Start about the pose in this file, as the pose.yaml of an earlier run: where that ended")
      ->excludes("--start");
  verb->add_option("--skip", request->skipped, "Leave out the log's first so many s: start later on the way")
      ->check(CLI::NonNegativeNumber);
  verb->add_option(
          "--kidnap", request->kidnapping,
          "AT SKIP: carry the robot off AT s after the log's start: the next SKIP s are left out, odometry too")
      ->expected(2)
      ->check(CLI::PositiveNumber);
  verb->add_option("--drop-images", request->disturbance.dropped_images, "Lose this share of the images, at random");
  verb->add_option("--dim", request->dimming,
                   "AT FOR LIGHT: leave the cameras this part of the light, AT s after the log's start, FOR so many s; "
                   "0: something covers them")
      ->expected(3)
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--odometry-scale", request->disturbance.odometry_scale,
                   "Multiply the distances that the odometry tells: a wrong wheel radius");
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "camera_stream.h"
#include "choice_option.h"
#include "coverage.h"
#include "odometry_reading.h"
#include "ordered_parallel.h"
#include "peer_methods.h"
#include "progress_bar.h"
#include "relocalization_report.h"
#include "verbs.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/query_image.h"
#include "vmcl/relocalization/temporal_rig.h"

namespace vmcl {
namespace {

struct Arguments {
  std::string map, rawlog, groundtruth, out;
  RelocalizerOptions options;
  TemporalRigOptions temporal_rig{.frames = 1};
  bool rig = false;
  bool peers = false;
  int every = 1;
  int threads = 1;
};

/// The images that are localized together: one, or those that the cameras of a rig took at the same time.
using Shot = std::vector<CameraObservation>;

/// Every `every`-th of the images as they come, or by the time they were taken at.
class ShotReader {
 public:
  ShotReader(CameraStream& stream, bool is_rig, int every) : stream_(stream), is_rig_(is_rig), every_(every) {}

  bool next(Shot& shot) {
    for (int passed_over = 1; passed_over < every_ && taken_; ++passed_over)
      if (!read(shot)) return false;
    taken_ = read(shot);
    return taken_;
  }

 private:
  bool read(Shot& shot) {
    constexpr double same_time = 0.01;  // s
    shot.clear();
    while (waiting_ || (waiting_ = stream_.next())) {
      const auto isOfAnotherShot = [&](const CameraObservation& taken) {
        return !is_rig_ || waiting_->label == taken.label || std::abs(waiting_->time - taken.time) > same_time;
      };
      if (std::ranges::any_of(shot, isOfAnotherShot)) break;
      shot.push_back(*std::exchange(waiting_, std::nullopt));
    }
    return !shot.empty();
  }

  CameraStream& stream_;
  bool is_rig_;
  int every_;
  bool taken_ = false;  ///< whether there was a shot before
  std::optional<CameraObservation> waiting_;
};

struct Outcome {
  ImageResult image;
  RelocalizationResult matched;
  std::string failure;  ///< why the images cannot be used; empty for usable ones
};

Outcome matchShot(const Relocalizer& relocalizer, const Shot& shot) try {
  std::vector<QueryImage> queries;
  std::string labels;
  for (const CameraObservation& observation : shot) {
    queries.push_back(queryImage(observation, relocalizer.map()));
    labels += (labels.empty() ? "" : "+") + observation.label;
  }
  return {{shot.front().time, labels}, relocalizer.match(queries), {}};
} catch (const std::exception& error) {
  return {{shot.front().time, shot.front().label}, {}, errorMessage(error)};
}

/// The pose from the matches, by peers as well if asked for, and its errors.
class Estimation {
 public:
  Estimation(const Relocalizer& relocalizer, const Trajectory& groundtruth, bool with_peers)
      : relocalizer_(relocalizer), groundtruth_(groundtruth) {
    if (with_peers) peers_.emplace(relocalizer.map(), relocalizer.options());
  }

  void complete(Outcome& outcome) const {
    ImageResult& image = outcome.image;
    const auto start = std::chrono::steady_clock::now();
    image.estimate = estimatePose(outcome.matched, relocalizer_.map(), relocalizer_.options());
    image.times = outcome.matched.times;
    image.times.estimation = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    image.matches = outcome.matched.problem.matches.size();
    image.has_truth = groundtruth_.at(image.time, max_gap_).has_value();
    if (image.estimate.found()) image.error = errorOf(image, image.estimate.modes.front().robot_in_map);
    image.references = referencesOf(outcome.matched);
    if (!peers_) return;
    for (const auto& [name, pose] : peers_->poses(outcome.matched))
      image.peers.push_back({name, pose ? errorOf(image, *pose) : std::nullopt});
  }

 private:
  std::optional<PoseError> errorOf(const ImageResult& image, const PlanarPose& robot_in_map) const {
    return poseError({image.time, true, robot_in_map}, groundtruth_, max_gap_);
  }

  const Relocalizer& relocalizer_;
  const Trajectory& groundtruth_;
  std::optional<PeerMethods> peers_;
  const double max_gap_ = EvaluationOptions().max_gap;
};

/// Joins the matches of frames by odometry.
class FrameTie {
 public:
  FrameTie(const TemporalRigOptions& options, Trajectory odometry) : rig_(options), odometry_(std::move(odometry)) {}

  void extend(Outcome& outcome) {
    const auto odometry_from_robot = odometry_.at(outcome.image.time);
    if (odometry_from_robot)
      outcome.matched = rig_.add(outcome.matched, planarPart(*odometry_from_robot));
    else
      outcome.failure = "no odometry at its time";
  }

 private:
  TemporalRig rig_;
  Trajectory odometry_;
};

/// Relocalizes all images, `threads` at a time, in the order of the log. Frames that are tied together wait for each
/// other, so that only their matching runs in parallel.
std::vector<ImageResult> relocalizeAll(CameraStream& stream, const Relocalizer& relocalizer,
                                       const Trajectory& groundtruth, const Arguments& arguments) {
  std::vector<ImageResult> results;
  ProgressBar bar;
  ShotReader reader(stream, arguments.rig, arguments.every);
  const Estimation estimation(relocalizer, groundtruth, arguments.peers);
  std::optional<FrameTie> tie;
  if (arguments.temporal_rig.frames > 1) tie.emplace(arguments.temporal_rig, readOdometry(arguments.rawlog));
  orderedParallel<Shot, Outcome>(
      arguments.threads,
      [&](Shot& shot) {
        bar.update("relocalizing", stream.progress());
        return reader.next(shot);
      },
      [&](const Shot& shot) {
        Outcome outcome = matchShot(relocalizer, shot);
        if (outcome.failure.empty() && !tie) estimation.complete(outcome);
        return outcome;
      },
      [&](Outcome outcome) {
        if (outcome.failure.empty() && tie) tie->extend(outcome);
        if (outcome.failure.empty() && tie) estimation.complete(outcome);
        if (outcome.failure.empty())
          results.push_back(std::move(outcome.image));
        else
          stream.reject(outcome.image.label, outcome.image.time, outcome.failure);
      });
  return results;
}

ExitCode run(const Arguments& arguments) {
  const Relocalizer relocalizer(std::make_shared<const KeyframeMap>(loadMap(arguments.map)), arguments.options);
  Trajectory groundtruth;
  if (!arguments.groundtruth.empty()) groundtruth = readTumTrajectory(arguments.groundtruth);
  CameraStream stream(arguments.rawlog);
  const std::vector<ImageResult> results = relocalizeAll(stream, relocalizer, groundtruth, arguments);
  ProblemReport problems = stream.problems();
  if (results.empty())
    throw std::runtime_error(problems.empty() ? arguments.rawlog + ": no camera images" : problems.inOneLine());
  if (!arguments.groundtruth.empty() &&
      std::none_of(results.begin(), results.end(), [](const ImageResult& image) { return image.has_truth; }))
    problems.add(arguments.groundtruth + ": " + coversNothing(groundtruth, results.front().time, results.back().time));
  problems.print("relocalize");
  if (!arguments.out.empty()) {
    const std::filesystem::path directory = arguments.out;
    std::filesystem::create_directories(directory);
    writeResults(directory / "relocalize.csv", results);
    writeTiming(directory / "timing.csv", results);
    if (arguments.peers) writePeers(directory / "peers.csv", results);
  }
  printTable(results);
  return problems.empty() ? exit_done : exit_some_input_bad;
}

}  // namespace

void addRelocalizeVerb(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("relocalize", "Find the robot from each camera image of a log by itself");
  verb->add_option("--map", arguments->map, "Map to find the robot in (.vmap)")->required();
  verb->add_option("--rawlog", arguments->rawlog, "Log with the camera images")->required();
  verb->add_option("--groundtruth", arguments->groundtruth, "True poses (TUM format) to compare with");
  verb->add_option("--out", arguments->out, "Directory for relocalize.csv, timing.csv and peers.csv");
  verb->add_option("--retrieved", arguments->options.retrieved, "Keyframes that each image is matched with")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  verb->add_option("--ranked", arguments->options.ranked,
                   "Most alike keyframes, from which those that match best are chosen; 0: the most alike")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  addChoice(
      *verb, "--setting", arguments->options.setting,
      std::map<std::string, MatchSetting>{
          {"scsd", MatchSetting::scsd}, {"dcsd", MatchSetting::dcsd}, {"dcdd", MatchSetting::dcdd}},
      "Matches at features with depth at landmarks (scsd), also anywhere in between (dcsd), with depth there, too "
      "(dcdd); the latter two need a map made with --dense");
  verb->add_option("--dense-network", arguments->options.dense_network,
                   ".onnx file of a network that finds the matches anywhere in between; without it gradients do");
  verb->add_option("--frames", arguments->temporal_rig.frames,
                   "Frames localized together, tied by odometry; 0.25 m or 20 deg apart")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  verb->add_option_function<std::string>(
          "--solution",
          [arguments](const std::string& name) {
            arguments->options.solution_of_map = name == "map";
            arguments->options.estimator.solver = name == "1p1dp" ? Solver::one_point_one_depth
                                                  : name == "2dp" ? Solver::two_depth
                                                                  : Solver::automatic;
          },
          "Samples drawn: of one kind, 1p1dp or 2dp; both (the default); or map, of the kind that the keyframes name")
      ->check(CLI::IsMember({"1p1dp", "2dp", "both", "map"}));
  verb->add_option("--every", arguments->every, "Take only every such image, or shot of a rig")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  verb->add_flag("--rig", arguments->rig, "Localize images that several cameras took at the same time together");
  verb->add_flag("--peers", arguments->peers, "Also say how well other methods do from the same matches");
  verb->add_option("--seed", arguments->options.estimator.seed, "Same seed, same answers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--threads", arguments->threads, "Images worked on at a time; more than 1 lengthens the latencies")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  verb->footer(
      "A camera labelled as a camera of the map is taken to be mounted and calibrated as the map has it.\n"
      "relocalize.csv holds poses in m and rad; the same seed gives the same bytes. timing.csv (s) does not.\n\n"
      "Example:\n  vmcl relocalize --map lab.vmap --rawlog query.rawlog --groundtruth groundtruth.txt --out results");
  verb->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <memory>

#include "camera_stream.h"
#include "coverage.h"
#include "ordered_parallel.h"
#include "progress_bar.h"
#include "relocalization_report.h"
#include "verbs.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/query_image.h"

namespace vmcl {
namespace {

struct Arguments {
  std::string map, rawlog, groundtruth, out;
  int retrieved = RelocalizerOptions().retrieved;
  uint64_t seed = EstimatorOptions().seed;
  int threads = 1;
};

struct Outcome {
  ImageResult image;
  std::string failure;  ///< why the image cannot be used; empty for a usable one
};

Outcome relocalizeImage(const Relocalizer& relocalizer, const CameraObservation& observation,
                        const Trajectory& groundtruth) try {
  const QueryImage query = queryImage(observation, relocalizer.map());
  RelocalizationResult result = relocalizer.relocalize({&query, 1});
  ImageResult image{observation.time, observation.label, result.problem.matches.size(), std::move(result.estimate),
                    result.times};
  const double max_gap = EvaluationOptions().max_gap;
  image.has_truth = groundtruth.at(image.time, max_gap).has_value();
  if (image.estimate.found())
    image.error = poseError({image.time, true, image.estimate.modes.front().robot_in_map}, groundtruth, max_gap);
  return {std::move(image), {}};
} catch (const std::exception& error) {
  return {{observation.time, observation.label}, errorMessage(error)};
}

/// Relocalizes all images, `threads` at a time, in the order of the log.
std::vector<ImageResult> relocalizeAll(CameraStream& stream, const Relocalizer& relocalizer,
                                       const Trajectory& groundtruth, int threads) {
  std::vector<ImageResult> results;
  ProgressBar bar;
  orderedParallel<CameraObservation, Outcome>(
      threads,
      [&](CameraObservation& camera) {
        std::optional<CameraObservation> next = stream.next();
        if (next) camera = std::move(*next);
        bar.update("relocalizing", stream.progress());
        return next.has_value();
      },
      [&](const CameraObservation& camera) { return relocalizeImage(relocalizer, camera, groundtruth); },
      [&](Outcome outcome) {
        if (outcome.failure.empty())
          results.push_back(std::move(outcome.image));
        else
          stream.reject(outcome.image.label, outcome.image.time, outcome.failure);
      });
  return results;
}

ExitCode run(const Arguments& arguments) {
  RelocalizerOptions options;
  options.retrieved = arguments.retrieved;
  options.estimator.seed = arguments.seed;
  const Relocalizer relocalizer(std::make_shared<const KeyframeMap>(loadMap(arguments.map)), options);
  Trajectory groundtruth;
  if (!arguments.groundtruth.empty()) groundtruth = readTumTrajectory(arguments.groundtruth);
  CameraStream stream(arguments.rawlog);
  const std::vector<ImageResult> results = relocalizeAll(stream, relocalizer, groundtruth, arguments.threads);
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
  verb->add_option("--out", arguments->out, "Directory for relocalize.csv and timing.csv");
  verb->add_option("--retrieved", arguments->retrieved, "Keyframes that each image is matched with")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  verb->add_option("--seed", arguments->seed, "Same seed, same answers")
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

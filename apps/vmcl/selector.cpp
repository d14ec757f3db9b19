// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "camera_stream.h"
#include "choice_option.h"
#include "coverage.h"
#include "ordered_parallel.h"
#include "problem_report.h"
#include "progress_bar.h"
#include "solution_trials.h"
#include "verbs.h"
#include "vmcl/evaluation/trajectory_error.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mapping/heat_map.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/error_message.h"

namespace vmcl {
namespace {

struct DataArguments {
  std::string map, rawlog, groundtruth, out;
  RelocalizerOptions options{.retrieved = 10, .ranked = 0};
  Judge judge = Judge::counting;
  int width = 0, height = 0;  ///< of the heat maps; 0: of the camera's images
  int every = 1;
  int threads = 1;
};

struct QueryWithTruth {
  CameraObservation observation;
  PlanarPose truth;
};

struct TrialsOfImage {
  std::vector<SolutionTrial> trials;
  std::string label, failure;
  double time = 0;
};

/// Every `every`-th image that the ground truth covers.
bool nextQuery(CameraStream& stream, const Trajectory& groundtruth, int every, int& count, QueryWithTruth& query) {
  while (auto observation = stream.next()) {
    const auto truth = groundtruth.at(observation->time, EvaluationOptions().max_gap);
    if (!truth || count++ % every != 0) continue;
    query = {*std::move(observation), planarPart(*truth)};
    return true;
  }
  return false;
}

std::vector<SolutionTrial> allTrials(CameraStream& stream, const Relocalizer& relocalizer,
                                     const DataArguments& arguments) {
  const Trajectory groundtruth = readTumTrajectory(arguments.groundtruth);
  std::vector<SolutionAnalysis> analyses;
  for (const Keyframe& keyframe : relocalizer.map().keyframes)
    analyses.push_back(analyzeSolutions(relocalizer.map(), keyframe, arguments.options));
  std::vector<SolutionTrial> all;
  ProgressBar bar;
  int count = 0;
  orderedParallel<QueryWithTruth, TrialsOfImage>(
      arguments.threads,
      [&](QueryWithTruth& query) {
        bar.update("solving", stream.progress());
        return nextQuery(stream, groundtruth, arguments.every, count, query);
      },
      [&](const QueryWithTruth& query) {
        TrialsOfImage done{{}, query.observation.label, {}, query.observation.time};
        try {
          done.trials = solutionTrials(relocalizer, analyses, query.observation, query.truth, arguments.judge);
        } catch (const std::exception& error) {
          done.failure = errorMessage(error);
        }
        return done;
      },
      [&](const TrialsOfImage& done) {
        all.insert(all.end(), done.trials.begin(), done.trials.end());
        if (!done.failure.empty()) stream.reject(done.label, done.time, done.failure);
      });
  if (count == 0) throw std::runtime_error(arguments.groundtruth + ": covers no image of " + arguments.rawlog);
  return all;
}

/// Heat maps of the keyframes with a label, and labels.csv.
void writeExamples(const std::filesystem::path& directory, const KeyframeMap& map, const std::vector<Solver>& labels,
                   const DataArguments& arguments) {
  AtomicFile list(directory / "labels.csv");
  list.stream() << "image,better\n";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == Solver::automatic) continue;
    const Keyframe& keyframe = map.keyframes[i];
    const PinholeCamera& camera = map.cameras[static_cast<std::size_t>(keyframe.camera)].calibration.pinhole;
    const std::string name = "keyframe-" + std::to_string(i) + ".png";
    writePng(directory / name, heatMap(map, keyframe, arguments.width > 0 ? arguments.width : camera.width,
                                       arguments.height > 0 ? arguments.height : camera.height)
                                   .view());
    list.stream() << name << ',' << nameOf(labels[i]) << '\n';
  }
  list.commit();
}

int runData(const DataArguments& arguments) {
  if ((arguments.width > 0) != (arguments.height > 0))
    throw std::runtime_error("selector data: --width and --height go together");
  const Relocalizer relocalizer(std::make_shared<const KeyframeMap>(loadMap(arguments.map)), arguments.options);
  CameraStream stream(arguments.rawlog);
  const std::vector<SolutionTrial> trials = allTrials(stream, relocalizer, arguments);
  const std::vector<Solver> labels = labelsOf(trials, relocalizer.map().keyframes.size());
  std::filesystem::create_directories(arguments.out);
  writeTrials(std::filesystem::path(arguments.out) / "trials.csv", trials);
  writeExamples(arguments.out, relocalizer.map(), labels, arguments);
  stream.problems().print("selector data");
  std::cout << trials.size() << " pairs of image and keyframe matched; better by over 0.25 m: 1P1DP at "
            << std::ranges::count(labels, Solver::one_point_one_depth) << " keyframes, 2DP at "
            << std::ranges::count(labels, Solver::two_depth) << '\n';
  printCalibration(trials);
  return stream.problems().empty() ? exit_done : exit_some_input_bad;
}

struct ChooseArguments {
  std::string map, network, output, table;
};

void writeTable(const std::filesystem::path& file, const KeyframeMap& map) {
  AtomicFile output(file);
  output.stream() << "keyframe,time,solution,gamma,chance_1p1dp,chance_2dp,sigma_1p1dp,sigma_2dp\n";
  for (std::size_t i = 0; i < map.keyframes.size(); ++i) {
    const Keyframe& keyframe = map.keyframes[i];
    const SolutionAnalysis analysis = analyzeSolutions(map, keyframe, {});
    const auto &one = analysis.one_point_one_depth, &two = analysis.two_depth;
    output.stream() << i << ',' << keyframe.time << ',' << nameOf(keyframe.solution) << ','
                    << analysis.rates.reliable_depth << ',' << one.chance() << ',' << two.chance() << ','
                    << one.sigma_position << ',' << two.sigma_position << '\n';
  }
  output.commit();
}

int runChoose(const ChooseArguments& arguments) {
  KeyframeMap map = loadMap(arguments.map);
  if (!arguments.output.empty()) AtomicFile(arguments.output);  // fails now rather than after the work
  const auto start = std::chrono::steady_clock::now();
  int exit_code = exit_done;
  if (arguments.network.empty()) {
    chooseByAnalysis(map, {});
  } else {
    try {
      chooseByNetwork(map, SolutionNetwork(arguments.network), {});
    } catch (const std::runtime_error& error) {
      std::cerr << "vmcl: selector choose: " << error.what() << "; the analysis chooses\n";
      chooseByAnalysis(map, {});
      exit_code = exit_some_input_bad;
    }
  }
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  if (!arguments.output.empty()) saveMap(arguments.output, map);
  if (!arguments.table.empty()) writeTable(arguments.table, map);
  const auto count = [&](Solver solution) { return std::ranges::count(map.keyframes, solution, &Keyframe::solution); };
  std::cout << "1P1DP at " << count(Solver::one_point_one_depth) << " keyframes, 2DP at " << count(Solver::two_depth)
            << ", no choice at " << count(Solver::automatic) << "; " << std::fixed << std::setprecision(2)
            << taken.count() / static_cast<double>(std::max<std::size_t>(1, map.keyframes.size()))
            << " ms a keyframe\n";
  return exit_code;
}

struct AskArguments {
  std::string network;
  std::vector<std::string> images;
};

int runAsk(const AskArguments& arguments) {
  const SolutionNetwork network(arguments.network);
  std::cout << "image,1p1dp,2dp\n" << std::setprecision(std::numeric_limits<float>::max_digits10);
  ProblemReport problems;
  bool answered = false;
  for (const std::string& file : arguments.images) {
    try {
      const ColourImage image = readColourImage(file);
      const auto [one, two] = network(image.view());
      std::cout << file << ',' << one << ',' << two << '\n';
      answered = true;
    } catch (const std::invalid_argument& error) {
      problems.add(file + ": " + error.what());
    } catch (const std::runtime_error& error) {  // which names the file
      problems.add(error.what());
    }
  }
  if (!answered) throw std::runtime_error(problems.inOneLine());
  problems.print("selector ask");
  return problems.empty() ? exit_done : exit_some_input_bad;
}

void addData(CLI::App& verb, int& exit_code) {
  const auto arguments = std::make_shared<DataArguments>();
  CLI::App* data = verb.add_subcommand("data", "See by a drive with known poses which solution is better where");
  data->add_option("--map", arguments->map, "Map to find the robot in (.vmap)")->required();
  data->add_option("--rawlog", arguments->rawlog, "Log with the camera images")->required();
  data->add_option("--groundtruth", arguments->groundtruth, "True poses (TUM format)")->required();
  data->add_option("--out", arguments->out, "Directory for heat maps, labels.csv and trials.csv")->required();
  data->add_option("--retrieved", arguments->options.retrieved, "Keyframes that each image is matched with, one by one")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  addChoice(*data, "--judge", arguments->judge,
            std::map<std::string, Judge>{{"counting", Judge::counting}, {"likelihood", Judge::likelihood}},
            "Whose samples of either solution are compared: the paper's RANSAC, which counts inliers (the default), or "
            "vmcl's");
  data->add_option("--width", arguments->width, "Of the heat maps, pixels; as the images are if left out")
      ->check(CLI::Range(8, 4096));
  data->add_option("--height", arguments->height, "Likewise")->check(CLI::Range(8, 4096));
  data->add_option("--every", arguments->every, "Take only every such image")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  data->add_option("--threads", arguments->threads, "Images worked on at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  data->footer(
      "Prints how well the analysis predicts the success of a sample.\n\nExample:\n  vmcl selector data --map lab.vmap "
      "--rawlog drive.rawlog --groundtruth drive.tum --out data/lab --width 160 --height 120");
  data->callback([arguments, &exit_code] { exit_code = runData(*arguments); });
}

void addChoose(CLI::App& verb, int& exit_code) {
  const auto arguments = std::make_shared<ChooseArguments>();
  CLI::App* choose = verb.add_subcommand("choose", "Choose a map's solutions by analysis or by a network");
  choose->add_option("MAP", arguments->map, "the .vmap")->required();
  choose->add_option("--network", arguments->network, "ONNX file; the analysis chooses if left out or unusable");
  choose->add_option("-o,--output", arguments->output, "the .vmap to write, with the choices");
  choose->add_option("--table", arguments->table, "CSV to write: choice and analysis of each keyframe");
  choose->footer("Example:\n  vmcl selector choose lab.vmap --network compact.onnx -o lab-chosen.vmap");
  choose->callback([arguments, &exit_code] { exit_code = runChoose(*arguments); });
}

void addAsk(CLI::App& verb, int& exit_code) {
  const auto arguments = std::make_shared<AskArguments>();
  CLI::App* ask = verb.add_subcommand("ask", "Print what a network says of heat maps: its two outputs");
  ask->add_option("NETWORK", arguments->network, "ONNX file")->required();
  ask->add_option("IMAGE", arguments->images, "heat maps as `selector data` writes them")->required();
  ask->footer("Example:\n  vmcl selector ask compact.onnx data/lab/keyframe-12.png");
  ask->callback([arguments, &exit_code] { exit_code = runAsk(*arguments); });
}

}  // namespace

void addSelectorVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "selector", "Choose between the solutions 1P1DP and 2DP for each keyframe of a map, or learn to do so");
  verb->require_subcommand(1);
  verb->footer(
      "Each explains itself, and share/selector/README.md the way from data to network.\n\n"
      "Example:\n  vmcl selector choose lab.vmap -o lab-chosen.vmap");
  addData(*verb, exit_code);
  addChoose(*verb, exit_code);
  addAsk(*verb, exit_code);
}

}  // namespace vmcl

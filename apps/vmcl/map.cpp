// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <memory>

#include "map_summary.h"
#include "posed_images.h"
#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/evaluation/map_picture.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/relocalization/solution_choice.h"

namespace vmcl {
namespace {

struct MapArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> trajectories;
  std::string info;
  std::string picture;
  std::vector<std::string> masks;
  std::string features = "sift";
  double keyframe_rotation_deg = MapBuilderOptions().keyframe_rotation / degree;
  double sigma_heading_deg = MapBuilderOptions().sigma_heading / degree;
  double sigma_tilt_deg = MapBuilderOptions().sigma_tilt / degree;
  double sigma_mount_tilt_deg = MapBuilderOptions().sigma_mount_tilt / degree;
  MapBuilderOptions options;

  MapBuilderOptions builderOptions() const {
    MapBuilderOptions complete = options;
    complete.features.choose(features);
    complete.keyframe_rotation = keyframe_rotation_deg * degree;
    complete.sigma_heading = sigma_heading_deg * degree;
    complete.sigma_tilt = sigma_tilt_deg * degree;
    complete.sigma_mount_tilt = sigma_mount_tilt_deg * degree;
    return complete;
  }
};

bool isSimpleMap(const std::string& input) { return input.ends_with(".simplemap") || input.ends_with(".simplemap.gz"); }

/// Masks by camera label, from words LABEL=FILE; a word FILE is for every other camera and has the label "".
std::map<std::string, Image> readMasks(const std::vector<std::string>& words) {
  std::map<std::string, Image> masks;
  for (const std::string& word : words) {
    const auto sign = word.find('=');
    const std::string label = sign == std::string::npos ? "" : word.substr(0, sign);
    if (!masks.try_emplace(label, readImage(word.substr(sign == std::string::npos ? 0 : sign + 1))).second)
      throw std::runtime_error("map: more than one --mask for " +
                               (label.empty() ? "all cameras" : "camera '" + label + "'"));
  }
  return masks;
}

/// What is wrong with the way the verb was called.
void checkUsage(const MapArguments& arguments) {
  if (arguments.inputs.empty()) throw std::runtime_error("map: INPUT is required");
  if (arguments.output.empty()) throw std::runtime_error("map: --output is required");
  const auto rawlogs = std::ranges::count_if(arguments.inputs, [](const auto& input) { return !isSimpleMap(input); });
  if (std::ssize(arguments.trajectories) > rawlogs)
    throw std::runtime_error("map: a simplemap has its own poses: --trajectory is for rawlogs, one each");
  if (std::ssize(arguments.trajectories) < rawlogs)
    throw std::runtime_error("map: the poses of a rawlog are needed: give --trajectory for each, in their order");
}

/// What is wrong where a trajectory leaves one place for another; empty where it does not.
std::string jumpIn(const Trajectory& trajectory) {
  constexpr double fastest = 15, slip = 0.5;  // m/s that a robot may drive, m that a correction may shift it
  const std::vector<StampedPose>& poses = trajectory.poses();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double way = (poses[i].map_from_robot.translation() - poses[i - 1].map_from_robot.translation()).norm();
    if (way > slip + fastest * (poses[i].time - poses[i - 1].time))
      return "jumps by " + std::to_string(way) + " m at time " + std::to_string(poses[i].time);
  }
  return {};
}

/// Every input is a session. One of which nothing can be used is a problem, unless it is the only one.
void readSessions(const MapArguments& arguments, MapBuilder& builder, PosedImages& images, ProgressBar& bar) {
  auto trajectory = arguments.trajectories.begin();
  for (std::size_t i = 0; i < arguments.inputs.size(); ++i) {
    const std::string& input = arguments.inputs[i];
    const auto reading = [&](double share) {
      bar.update("reading", (static_cast<double>(i) + share) / static_cast<double>(arguments.inputs.size()));
    };
    const int images_before = images.images(), keyframes_before = builder.keyframeCount();
    builder.startSession();
    if (isSimpleMap(input)) {
      images.readSimpleMap(input, reading);
    } else {
      const Trajectory poses = readTumTrajectory(*trajectory);
      if (const std::string jump = jumpIn(poses); !jump.empty()) images.addProblem(*trajectory + ": " + jump);
      images.readRawlog(input, poses, reading);
      ++trajectory;
    }
    if (builder.keyframeCount() > keyframes_before) continue;
    images.addProblem(input + (images.images() == images_before ? ": no camera images" : ": no image has a pose"));
  }
  if (builder.keyframeCount() == 0) throw std::runtime_error(images.problems().inOneLine());
}

int runMap(const MapArguments& arguments) {
  if (!arguments.info.empty()) {
    const auto map = std::make_shared<const KeyframeMap>(loadMap(arguments.info));
    if (!arguments.picture.empty()) drawMap(arguments.picture, map);
    printInfo(arguments.info, *map);
    return exit_done;
  }
  checkUsage(arguments);
  AtomicFile(arguments.output);  // fails now rather than after the work
  ProgressBar bar;
  MapBuilder builder({}, arguments.builderOptions());
  PosedImages images(builder, readMasks(arguments.masks));
  readSessions(arguments, builder, images, bar);
  if (const std::string label = images.maskWithoutCamera(); !label.empty())
    throw std::runtime_error("map: --mask: no camera '" + label + "' in the input");
  auto [built, report] = builder.build([&](std::string_view stage, double share) { bar.update(stage, share); });
  chooseByAnalysis(built, {});
  const auto map = std::make_shared<const KeyframeMap>(std::move(built));
  saveMap(arguments.output, *map);
  for (int session : sessionsApart(*map))
    images.addProblem("session " + std::to_string(session) +
                      ": shares no landmark with the others; only its given poses say where it lies");
  if (!arguments.picture.empty()) drawMap(arguments.picture, map);
  images.problems().print("map");
  std::cout << images.images() << " images, " << images.imagesWithoutPose() << " of them without a pose; "
            << report.keyframes << " keyframes, " << report.features << " features\n";
  printSummary(report, *map);
  return images.problems().empty() ? exit_done : exit_some_input_bad;
}

void addBuilderOptions(CLI::App& verb, MapArguments& arguments) {
  MapBuilderOptions& options = arguments.options;
  verb.add_option("--features", arguments.features, "orb, sift, akaze, or the .onnx file of a network")
      ->capture_default_str();
  verb.add_option(
      "--places", options.place_network.file,
      ".onnx file of a network that describes whole images for place recognition; without it their features "
      "do");
  verb.add_option("--max-features", options.features.max_features, "strongest features kept of an image")
      ->capture_default_str();
  verb.add_option("--mask-rows-from-top", options.features.mask_rows_from_top,
                  "rows of the image that show the robot itself")
      ->capture_default_str();
  verb.add_option("--mask", arguments.masks,
                  "[LABEL=]FILE: image of the size of a camera's that is white where it shows the robot itself")
      ->allow_extra_args(false);
  const auto addAmount = [&verb](const char* name, double& value, const char* help) {
    verb.add_option(name, value, help)->check(CLI::Range(0.0, 1e6))->capture_default_str();
  };
  addAmount("--keyframe-distance", options.keyframe_distance, "a new keyframe after this way (m)");
  addAmount("--keyframe-rotation-deg", arguments.keyframe_rotation_deg, "or this turn");
  verb.add_flag("--flat,!--not-flat", options.flat,
                "the robot stands level at height 0, the default; or as high and tilted as its poses say")
      ->capture_default_str();
  addAmount("--sigma-position", options.sigma_position, "standard deviation of the given positions (m)");
  addAmount("--sigma-heading-deg", arguments.sigma_heading_deg, "and headings");
  addAmount("--sigma-tilt-deg", arguments.sigma_tilt_deg,
            "standard deviation of the robot's roll and pitch about those of level ground or its poses; 0: exact");
  addAmount("--sigma-height", options.sigma_height, "and of its height (m)");
  addAmount("--sigma-mount-tilt-deg", arguments.sigma_mount_tilt_deg,
            "standard deviation of the given mount's roll, pitch and yaw; 0: exact");
  addAmount("--sigma-mount-shift", options.sigma_mount_shift,
            "standard deviation of the given mount's x and y (m); 0: exact");
  addAmount("--sigma-focal", options.sigma_focal, "standard deviation of the given focal length, relative; 0: exact");
  addAmount("--sigma-radial", options.sigma_radial,
            "standard deviation of the given radial distortion k1 and k2; 0: exact");
  verb.add_flag("--dense", options.dense, "keep the images, so that queries can be matched all over them");
  verb.add_option("--seed", options.seed, "of the vocabulary of place recognition")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

}  // namespace

void addMapVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "map",
      "Make a map of keyframes and landmarks from posed images: a rawlog and a trajectory, or a simplemap.\n"
      "Poses are taken as on flat ground. They and the camera mounts are adjusted within their standard deviations.");
  const auto arguments = std::make_shared<MapArguments>();
  verb->add_option("INPUT", arguments->inputs,
                   "a .rawlog, or a .simplemap (may be gzipped); several become the sessions of one map");
  verb->add_option("-o,--output", arguments->output, "the .vmap to write");
  verb->add_option("--trajectory", arguments->trajectories,
                   "poses of the robot for a rawlog, TUM format; once for each rawlog, all in one map frame")
      ->allow_extra_args(false);
  verb->add_option("--info", arguments->info, "only say what this .vmap holds");
  verb->add_option("--picture", arguments->picture, "show the map, too: FILE.svg, FILE.png and FILE.3Dscene")
      ->type_name("FILE");
  addBuilderOptions(*verb, *arguments);
  verb->footer(
      "Examples:\n"
      "  vmcl map drive.rawlog --trajectory drive.groundtruth.tum -o drive.vmap\n"
      "  vmcl map monday.rawlog friday.rawlog --trajectory monday.tum --trajectory friday.tum -o lab.vmap\n"
      "  vmcl map --info drive.vmap --picture drive");
  verb->callback([arguments, &exit_code] { exit_code = runMap(*arguments); });
}

}  // namespace vmcl

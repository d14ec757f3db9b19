// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>
#include <memory>

#include "posed_images.h"
#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mapping/map_file.h"

namespace vmcl {
namespace {

struct MapArguments {
  std::string input;
  std::string output;
  std::string trajectory;
  std::string info;
  std::vector<std::string> masks;
  std::string features = "sift";
  double keyframe_rotation_deg = MapBuilderOptions().keyframe_rotation / degree;
  double sigma_heading_deg = MapBuilderOptions().sigma_heading / degree;
  double sigma_mount_tilt_deg = MapBuilderOptions().sigma_mount_tilt / degree;
  MapBuilderOptions options;

  MapBuilderOptions builderOptions() const {
    MapBuilderOptions complete = options;
    complete.features.choose(features);
    complete.keyframe_rotation = keyframe_rotation_deg * degree;
    complete.sigma_heading = sigma_heading_deg * degree;
    complete.sigma_mount_tilt = sigma_mount_tilt_deg * degree;
    return complete;
  }

  bool readsSimpleMap() const { return input.ends_with(".simplemap") || input.ends_with(".simplemap.gz"); }
};

void print(const MapBuildReport& report, const KeyframeMap& map, const PosedImages& images) {
  std::cout << std::fixed << std::setprecision(2) << images.images() << " images, " << images.imagesWithoutPose()
            << " of them without a pose; " << report.keyframes << " keyframes, " << report.features << " features\n"
            << report.landmarks << " landmarks, seen " << report.mean_observations
            << " times each, median reprojection error " << report.median_reprojection_px << " px\n";
  for (std::size_t i = 0; i < map.cameras.size(); ++i) {
    const Eigen::Vector3d turn_deg = report.mount_correction[i] / degree;
    const Eigen::Vector3d& shift = report.mount_shift[i];
    std::cout << "camera '" << map.cameras[i].label << "': mount turned by roll " << turn_deg.x() << ", pitch "
              << turn_deg.y() << ", yaw " << turn_deg.z() << " deg, shifted by x " << std::setprecision(3) << shift.x()
              << ", y " << shift.y() << " m, focal length times " << report.focal_scale[i] << std::setprecision(2)
              << '\n';
  }
}

/// Of the image's area.
double maskedShare(const MapCamera& camera) {
  const auto& [width, height] = std::pair(camera.calibration.pinhole.width, camera.calibration.pinhole.height);
  int masked = std::min(camera.mask_rows_from_top, height) * width;
  for (std::size_t i = static_cast<std::size_t>(masked); i < camera.mask.pixels.size(); ++i)
    masked += camera.mask.pixels[i] >= 128;
  return static_cast<double>(masked) / (static_cast<double>(width) * height);
}

int runInfo(const std::string& file) {
  const KeyframeMap map = loadMap(file);
  std::cout << file << ": " << map.keyframes.size() << " keyframes, " << map.landmarks.size() << " landmarks, "
            << nameOf(map.feature_options.kind) << " features, " << map.vocabulary.words().rows()
            << " words of place recognition\n"
            << std::fixed;
  for (const MapCamera& camera : map.cameras) {
    const PinholeCamera& pinhole = camera.calibration.pinhole;
    std::cout << "camera '" << camera.label << "': " << pinhole.width << "x" << pinhole.height << std::setprecision(2)
              << ", fx " << pinhole.fx << ", fy " << pinhole.fy << ", cx " << pinhole.cx << ", cy " << pinhole.cy
              << ", distortion " << std::setprecision(4)
              << Eigen::Map<const Eigen::RowVector<double, 5>>(camera.calibration.distortion.data()) << ", mounted at "
              << camera.robot_from_camera.translation().transpose() << " m, " << std::setprecision(0)
              << 100 * maskedShare(camera) << " % masked\n";
  }
  return exit_done;
}

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

int runMap(const MapArguments& arguments) {
  if (!arguments.info.empty()) return runInfo(arguments.info);
  if (arguments.input.empty()) throw std::runtime_error("map: INPUT is required");
  if (arguments.output.empty()) throw std::runtime_error("map: --output is required");
  if (arguments.trajectory.empty() != arguments.readsSimpleMap())
    throw std::runtime_error(arguments.readsSimpleMap() ? "map: a simplemap has its own poses: leave --trajectory out"
                                                        : "map: the poses of a rawlog are needed: give --trajectory");
  AtomicFile(arguments.output);  // fails now rather than after the work
  ProgressBar bar;
  MapBuilder builder({}, arguments.builderOptions());
  PosedImages images(builder, readMasks(arguments.masks));
  const auto reading = [&](double share) { bar.update("reading", share); };
  if (arguments.readsSimpleMap())
    images.readSimpleMap(arguments.input, reading);
  else
    images.readRawlog(arguments.input, readTumTrajectory(arguments.trajectory), reading);
  if (const std::string label = images.maskWithoutCamera(); !label.empty())
    throw std::runtime_error("map: --mask: no camera '" + label + "' in " + arguments.input);
  if (images.images() == 0)
    throw std::runtime_error(images.problems().empty() ? arguments.input + ": no camera images"
                                                       : images.problems().inOneLine());
  if (builder.keyframeCount() == 0)
    throw std::runtime_error(images.problems().empty() ? arguments.input + ": no image has a pose"
                                                       : images.problems().inOneLine());
  const auto [map, report] = builder.build([&](std::string_view stage, double share) { bar.update(stage, share); });
  saveMap(arguments.output, map);
  images.problems().print("map");
  print(report, map, images);
  return images.problems().empty() ? exit_done : exit_some_input_bad;
}

void addBuilderOptions(CLI::App& verb, MapArguments& arguments) {
  MapBuilderOptions& options = arguments.options;
  verb.add_option("--features", arguments.features, "orb, sift, akaze, or the .onnx file of a network")->capture_default_str();
  verb.add_option("--max-features", options.features.max_features, "strongest features kept of an image")
      ->capture_default_str();
  verb.add_option("--mask-rows-from-top", options.features.mask_rows_from_top,
                  "rows of the image that show the robot itself")
      ->capture_default_str();
  verb.add_option("--mask", arguments.masks,
                  "[LABEL=]FILE: image of the size of a camera's that is white where it shows the robot itself")
      ->allow_extra_args(false);
  verb.add_option("--keyframe-distance", options.keyframe_distance, "a new keyframe after this way (m)")
      ->capture_default_str();
  verb.add_option("--keyframe-rotation-deg", arguments.keyframe_rotation_deg, "or this turn")->capture_default_str();
  verb.add_option("--sigma-position", options.sigma_position, "standard deviation of the given positions (m)")
      ->capture_default_str();
  verb.add_option("--sigma-heading-deg", arguments.sigma_heading_deg, "and headings")->capture_default_str();
  verb.add_option("--sigma-mount-tilt-deg", arguments.sigma_mount_tilt_deg,
                  "standard deviation of the given mount's roll, pitch and yaw; 0: exact")
      ->capture_default_str();
  verb.add_option("--sigma-mount-shift", options.sigma_mount_shift,
                  "standard deviation of the given mount's x and y (m); 0: exact")
      ->capture_default_str();
  verb.add_option("--sigma-focal", options.sigma_focal,
                  "standard deviation of the given focal length, relative; 0: exact")
      ->capture_default_str();
  verb.add_option("--sigma-radial", options.sigma_radial,
                  "standard deviation of the given radial distortion k1 and k2; 0: exact")
      ->capture_default_str();
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
  verb->add_option("INPUT", arguments->input, "a .rawlog, or a .simplemap (may be gzipped)");
  verb->add_option("-o,--output", arguments->output, "the .vmap to write");
  verb->add_option("--trajectory", arguments->trajectory, "poses of the robot for a rawlog, TUM format");
  verb->add_option("--info", arguments->info, "only say what this .vmap holds");
  addBuilderOptions(*verb, *arguments);
  verb->footer(
      "Examples:\n"
      "  vmcl map drive.rawlog --trajectory drive.groundtruth.tum -o drive.vmap\n"
      "  vmcl map --info drive.vmap");
  verb->callback([arguments, &exit_code] { exit_code = runMap(*arguments); });
}

}  // namespace vmcl

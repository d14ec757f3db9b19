// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>
#include <memory>

#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/datasets/simulator.h"

namespace vmcl {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string output;
  SimulationOptions options;
};

int runSimulate(const SimulateArguments& arguments) {
  ProgressBar bar;
  const auto report = simulate(arguments.scene, arguments.output, arguments.options,
                               [&](double share) { bar.update("simulate " + arguments.options.session, share); });
  std::cout << arguments.output << ": " << std::fixed << std::setprecision(1) << report.duration << " s, " << report.way
            << " m, " << report.images << " images, " << report.scans << " scans, " << report.odometry_readings
            << " odometry readings\n";
  if (report.map_frames > 0)
    std::cout << arguments.options.simplemap.string() << ": " << report.map_frames << " places\n";
  for (const std::string& image : report.missing_images)
    std::cout << image << " is missing: what should show it is drawn in plain colour\n";
  return exit_done;
}

}  // namespace

void addSimulateVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("simulate",
                         "Drive a robot with cameras, 2D laser and wheel odometry through furnished rooms. "
                         "Writes the rawlog X.rawlog, its\n"
                         "images to X_Images and the true poses to X.groundtruth.tum.");
  const auto arguments = std::make_shared<SimulateArguments>();
  SimulationOptions& options = arguments->options;
  verb->add_option("SCENE", arguments->scene, "scene file (YAML)")->required()->check(CLI::ExistingFile);
  verb->add_option("-o,--output", arguments->output, "the rawlog to write")->required();
  verb->add_option("--session", options.session,
                   "the drive, one of the sessions of the scene file; may be left out if there is only one");
  verb->add_option("--seed", options.seed, "of the sensors' noise")->check(CLI::NonNegativeNumber);
  verb->add_option("--simplemap", options.simplemap, "write also the true poses with images and scans, to map from");
  verb->add_option("--duration", options.duration, "stop after this time (s)")->check(CLI::NonNegativeNumber);
  verb->add_option("-I,--include", options.include_directories, "directory with scenes that this one includes")
      ->check(CLI::ExistingDirectory);
  verb->footer(
      "Examples:\n"
      "  vmcl simulate apartment.yaml --session map -o map.rawlog --simplemap map.simplemap\n"
      "  vmcl simulate apartment.yaml --session query --seed 2 -o query.rawlog\n"
      "  vmcl simulate aws_small_house.yaml -I DIRECTORY_OF_ITS_MESHES --session map -o house.rawlog");
  verb->callback([arguments, &exit_code] { exit_code = runSimulate(*arguments); });
}

}  // namespace vmcl

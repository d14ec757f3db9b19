// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/datasets/tum_import.h"

namespace vmcl {
namespace {

struct TumArguments {
  std::string directory;
  std::string output;
  TumImportOptions options;
};

int runTumImport(const TumArguments& arguments) {
  ProgressBar bar;
  const auto report = importTum(arguments.directory, arguments.output, arguments.options,
                                [&](double share) { bar.update("import", share); });
  for (const std::string& problem : report.problems) std::cerr << "vmcl import: " << problem << '\n';
  std::cout << arguments.output << ": " << report.images << " images, " << report.odometry_readings
            << " odometry readings, " << report.ground_truth_poses << " ground truth poses\n";
  if (report.mask_rows_from_top > 0)
    std::cout << "calibration.yaml masks the top " << report.mask_rows_from_top
              << " rows; a rawlog cannot say so: set mask_rows_from_top where the log is used\n";
  return report.problems.empty() ? exit_done : exit_some_input_bad;
}

}  // namespace

void addImportVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("import", "Make a rawlog of another format");
  verb->require_subcommand(1);
  CLI::App* tum = verb->add_subcommand(
      "tum",
      "Make a rawlog of a directory in the layout of the TUM RGB-D benchmark: rgb.txt and calibration.yaml,\n"
      "odometry.txt and groundtruth.txt where there are. Images go to X_Images, the ground truth to\n"
      "X.groundtruth.tum beside the log X.rawlog. Depth images (depth.txt) are not imported.");
  const auto arguments = std::make_shared<TumArguments>();
  tum->add_option("DIR", arguments->directory, "the directory")->required()->check(CLI::ExistingDirectory);
  tum->add_option("-o,--output", arguments->output, "the rawlog to write")->required();
  tum->add_option("--first-frame", arguments->options.first_frame, "first image, counting the lines of rgb.txt from 0");
  tum->add_option("--last-frame", arguments->options.last_frame, "last image");
  tum->footer("Example: vmcl import tum turtlebot_box -o query.rawlog --first-frame 770 --last-frame 851");
  tum->callback([arguments, &exit_code] { exit_code = runTumImport(*arguments); });
}

}  // namespace vmcl

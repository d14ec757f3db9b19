// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/datasets/image_folder_import.h"
#include "vmcl/datasets/openloris_import.h"
#include "vmcl/datasets/tum_import.h"

namespace vmcl {
namespace {

struct ImportArguments {
  std::string input;
  std::string output;
  TumImportOptions tum;
};

/// Where the input is, and how to read it.
using Importer = std::function<ImportReport(const ImportArguments&, const std::function<void(double share)>&)>;

int runImport(const ImportArguments& arguments, const Importer& import) {
  ImportReport report;
  {
    ProgressBar bar;
    report = import(arguments, [&](double share) { bar.update("import", share); });
  }
  for (const std::string& problem : report.problems) std::cerr << "vmcl import: " << problem << '\n';
  std::cout << arguments.output << ": " << report.images << " images, ";
  if (report.depth_images > 0) std::cout << report.depth_images << " with depth, ";
  if (report.scans > 0) std::cout << report.scans << " scans, ";
  std::cout << report.odometry_readings << " odometry readings, " << report.ground_truth_poses
            << " ground truth poses\n";
  return report.problems.empty() ? exit_done : exit_some_input_bad;
}

ImportReport runTum(const ImportArguments& arguments, const std::function<void(double share)>& progress) {
  const TumImportReport tum = importTum(arguments.input, arguments.output, arguments.tum, progress);
  if (tum.mask_rows_from_top > 0)
    std::cout
        << "calibration.yaml masks the top " << tum.mask_rows_from_top
        << " rows; a rawlog cannot say so: give vmcl map --mask-rows-from-top, and mask_rows_from_top in the ini\n";
  ImportReport report;
  report.images = tum.images;
  report.depth_images = tum.depth_images;
  report.odometry_readings = tum.odometry_readings;
  report.ground_truth_poses = tum.ground_truth_poses;
  report.problems = tum.problems;
  return report;
}

/// For a format without options of its own.
template <class Import>
Importer withoutOptions(Import* import) {
  return [import](const ImportArguments& arguments, const std::function<void(double share)>& progress) {
    return import(arguments.input, arguments.output, progress);
  };
}

CLI::App* addFormat(CLI::App& verb, const std::string& name, const std::string& description, int& exit_code,
                    const std::shared_ptr<ImportArguments>& arguments, const CLI::Validator& input,
                    const std::string& input_name, const Importer& importer) {
  CLI::App* format = verb.add_subcommand(name, description);
  format->add_option(input_name, arguments->input, "what to import")->required()->check(input);
  format->add_option("-o,--output", arguments->output, "the rawlog to write")->required();
  format->callback([arguments, importer, &exit_code] { exit_code = runImport(*arguments, importer); });
  return format;
}

}  // namespace

void addImportVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("import",
                                      "Make a rawlog X.rawlog of another format. Images go to X_Images, the ground "
                                      "truth to X.groundtruth.tum beside it");
  verb->require_subcommand(1);
  const auto arguments = std::make_shared<ImportArguments>();

  CLI::App* tum =
      addFormat(*verb, "tum",
                "Make a rawlog of a directory in the layout of the TUM RGB-D benchmark: rgb.txt and calibration.yaml,\n"
                "depth.txt, odometry.txt and groundtruth.txt where there are.",
                exit_code, arguments, CLI::ExistingDirectory, "DIR", runTum);
  tum->add_option("--first-frame", arguments->tum.first_frame, "first image, counting the lines of rgb.txt from 0");
  tum->add_option("--last-frame", arguments->tum.last_frame, "last image");
  tum->footer("Example: vmcl import tum turtlebot_box -o query.rawlog --first-frame 770 --last-frame 851");

  addFormat(*verb, "openloris",
            "Make a rawlog of a sequence of OpenLORIS-Scene: of its extracted directory or its ROS 1 bag. Takes the\n"
            "D435i's colour images with aligned depth, odometry, the laser's scans (of a bag) and the ground truth.",
            exit_code, arguments, CLI::ExistingPath, "DIR|BAG", withoutOptions(importOpenLoris))
      ->footer(
          "Examples:\n  vmcl import openloris home1-1 -o home1-1.rawlog\n"
          "  vmcl import openloris corridor1-1.bag -o corridor1-1.rawlog");

  addFormat(*verb, "images",
            "Make a rawlog of a directory of images whose names are their times in seconds, with calibration.yaml;\n"
            "poses.txt (TUM format) becomes the ground truth, odometry.txt the odometry, where there are.",
            exit_code, arguments, CLI::ExistingDirectory, "DIR", withoutOptions(importImages))
      ->footer("Example: vmcl import images DIR -o drive.rawlog");
}

}  // namespace vmcl

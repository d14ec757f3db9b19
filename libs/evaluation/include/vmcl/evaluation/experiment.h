// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vmcl/evaluation/localization_report.h"
#include "vmcl/mrpt/disturbance.h"
#include "vmcl/mrpt/sensors.h"

namespace vmcl {

/// Where a log stands in OpenLORIS-Scene, for its own evaluate.py.
struct OpenLorisSequence {
  std::string scene;
  int number = 0;
};

/// A log with the maps to localize it in.
struct ExperimentSession {
  std::string name;
  std::filesystem::path rawlog;
  std::vector<std::filesystem::path> maps;
  std::filesystem::path ground_truth;  ///< TUM format
  std::optional<OpenLorisSequence> openloris;
  Disturbance disturbance{};
};

/// An ini and what is changed of it.
struct Configuration {
  std::string name;
  std::filesystem::path ini;
  std::vector<std::string> changes;  ///< "section.key=value"
};

/// What the robot knows of where it starts.
struct Start {
  std::string name;
  bool given = true;                     ///< about; else nothing
  std::optional<Kidnapping> kidnapping;  ///< after a given start
  double after = 0;                      ///< s of the log's start that are left out
};

/// Each session with each sensor set, configuration, start and seed is a run. doc/file_formats.md has the file's form.
struct Experiment {
  std::filesystem::path file;
  std::vector<ExperimentSession> sessions;
  std::vector<Sensors> sensors;
  std::vector<Configuration> configurations;
  std::vector<Start> starts;
  int seeds = 1;              ///< 1 to this
  bool keep_matches = false;  ///< runs on the same log and map share what images have in common with the map
};

/// Relative paths start at the working directory or, if there is no such file, at the experiment's directory. All paths
/// returned are absolute, and there is a file at each. Throws std::runtime_error naming file, line, key and reason.
Experiment readExperiment(const std::filesystem::path& file);

}  // namespace vmcl

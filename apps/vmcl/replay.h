// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>

#include "problem_report.h"
#include "vmcl/mrpt/disturbance.h"
#include "vmcl/evaluation/localization_report.h"

namespace vmcl {

/// What of a log is replayed.
struct Replay {
  std::filesystem::path rawlog;
  double skipped = 0;                                       ///< s: so much of the log's start is left out,
  double begin = -std::numeric_limits<double>::infinity();  ///< and steps before this time
  std::optional<Kidnapping> kidnapping;
  Disturbance disturbance{};
  uint64_t seed = 1;  ///< of the images that get lost
};

/// Localizes the robot of the log; returns what was wrong with it. Throws std::runtime_error naming the log when
/// nothing of it can be read, or when it ends before the kidnapped robot has been seen again.
ProblemReport replay(const Replay& replay, Localizer& localizer, LocalizationRun& run);

/// The time of the first observation, so long (s) after the log's start, that the ground truth covers. Throws
/// std::runtime_error naming the log when there is none.
double firstCoveredTime(const std::filesystem::path& rawlog, const Trajectory& ground_truth, double skipped);

}  // namespace vmcl

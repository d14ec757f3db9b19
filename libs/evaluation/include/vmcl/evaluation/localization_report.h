// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "vmcl/evaluation/trajectory_error.h"
#include "vmcl/mrpt/localizer.h"

namespace vmcl {

/// The robot is to be carried off at a time (s from the first time in the log), and so is a part of the log (s).
struct Kidnapping {
  double at = 0;
  double skip = 0;
};

/// The log between these times (s) was left out, and the robot moved meanwhile.
struct Kidnapped {
  double from = 0;
  double until = 0;
};

/// All that one localization run has to show.
struct LocalizationRun {
  std::vector<LocalizationFrame> frames;
  std::optional<Trajectory> ground_truth;
  std::optional<Kidnapped> kidnapped;
};

/// The frames' estimates, for evaluateTrajectory.
std::vector<TimedEstimate> estimatesOf(const std::vector<LocalizationFrame>& frames);

/// Files about a run, each written aside and renamed; all throw std::runtime_error naming the file.
/// - trajectory.tum: the reported poses while localized, z = 0.
/// - frames.csv: a line an update: t, status (searching or localized), x, y, phi, covariance, ESS, particles, inliers.
/// - summary.json: figures, in SI units and radians; those against a ground truth only when there is one.
/// - timing.csv: the latency of each update. Apart, because it differs from run to run where the others do not.
void writeTrajectory(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames);
void writeFrames(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames);
void writeSummary(const std::filesystem::path& file, const LocalizationRun& run);
void writeTiming(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "run_files.h"

namespace vmcl {

/// All that is known of a run. Without measures, errors and cost unless it is done.
struct RunResult {
  Job job;
  RunEnd end;
  RunMeasures measures;
  std::vector<RunUpdate> updates;
  std::vector<PoseError> errors;  ///< of the updates that the ground truth covers
  RunCost cost;
};

/// The results of an experiment. Pointers into it stay good as long as it does.
struct ExperimentResults {
  Experiment experiment;
  ExperimentPlan plan;
  std::vector<Trajectory> ground_truths;  ///< of the sessions
  std::vector<RunResult> runs;            ///< in the order of the plan's jobs
};

/// Throws std::runtime_error naming the file that is broken.
ExperimentResults readResults(const Experiment& experiment, const ExperimentPlan& plan,
                              const std::filesystem::path& directory);

}  // namespace vmcl

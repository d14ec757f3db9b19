// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/evaluation/experiment_plan.h"

namespace vmcl {

/// A run without results, and why.
struct FailedRun {
  std::string id;
  std::string reason;
};

/// What a report is about, in short.
struct ReportSummary {
  std::size_t done = 0;
  std::vector<FailedRun> failed;
  std::size_t missing = 0;               ///< not run yet
  std::vector<FailedRun> with_problems;  ///< done, but with problems of the input
};

/// Writes tables, the page report.html and files for OpenLORIS' evaluate.py from the results in the directory.
/// `version` of the program. Throws std::runtime_error naming the file that is broken or cannot be written.
ReportSummary writeReport(const Experiment& experiment, const ExperimentPlan& plan,
                          const std::filesystem::path& directory, const std::string& version);

}  // namespace vmcl

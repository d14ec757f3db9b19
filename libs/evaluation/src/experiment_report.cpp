// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/experiment_report.h"

#include "experiment_page.h"
#include "experiment_tables.h"
#include "openloris_files.h"

namespace vmcl {
namespace {

ReportSummary summaryOf(const ExperimentResults& results) {
  ReportSummary summary;
  for (const RunResult& run : results.runs) {
    if (run.end.done) {
      ++summary.done;
      for (const std::string& problem : run.end.problems) summary.with_problems.push_back({run.job.id, problem});
    } else if (run.end.there) {
      summary.failed.push_back({run.job.id, run.end.reason});
    } else {
      ++summary.missing;
    }
  }
  return summary;
}

}  // namespace

ReportSummary writeReport(const Experiment& experiment, const ExperimentPlan& plan,
                          const std::filesystem::path& directory, const std::string& version) {
  const ExperimentResults results = readResults(experiment, plan, directory);
  writeTables(directory, results);
  writeOpenLorisFiles(directory, results);
  writePage(directory, results, version);
  return summaryOf(results);
}

}  // namespace vmcl

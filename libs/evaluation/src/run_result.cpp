// SPDX-License-Identifier: BSD-3-Clause
#include "run_result.h"

namespace vmcl {
namespace {

RunResult readRun(const Job& job, const Trajectory& ground_truth, const std::filesystem::path& directory) {
  RunResult run;
  run.job = job;
  run.end = readRunEnd(directory);
  if (!run.end.done) return run;
  run.updates = readUpdates(directory);
  run.measures = measureRun(run.updates, ground_truth, readKidnapped(directory));
  run.cost = readRunCost(directory);
  for (const RunUpdate& update : run.updates)
    if (const auto error = poseError(update.estimate, ground_truth, EvaluationOptions().max_gap))
      run.errors.push_back(*error);
  return run;
}

}  // namespace

ExperimentResults readResults(const Experiment& experiment, const ExperimentPlan& plan,
                              const std::filesystem::path& directory) {
  ExperimentResults results{experiment, plan, {}, {}};
  for (const ExperimentSession& session : experiment.sessions)
    results.ground_truths.push_back(readTumTrajectory(session.ground_truth));
  for (const Job& job : plan.jobs)
    results.runs.push_back(readRun(job, results.ground_truths[job.session], runDirectory(directory, job)));
  return results;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/evaluation/experiment_report.h"
#include "vmcl/evaluation/job_runner.h"

namespace vmcl {
namespace {

struct EvaluateRequest {
  std::filesystem::path experiment;
  std::filesystem::path directory;
  std::string job;
  int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool resume = false;
  bool list = false;
  bool report_only = false;
};

JobRunner runnerOf(const EvaluateRequest& request, const Experiment& experiment) {
  return {experiment, std::filesystem::absolute(request.directory), std::filesystem::read_symlink("/proc/self/exe")};
}

int listJobs(const EvaluateRequest& request, const Experiment& experiment, const std::vector<Job>& jobs) {
  const DirectoryLock lock(request.directory, DirectoryLock::Kind::shared);
  runnerOf(request, experiment).writeJobList(jobs);
  for (const Job& job : jobs) std::cout << job.id << '\n';
  return exit_done;
}

int runOneJob(const EvaluateRequest& request, const Experiment& experiment, const std::vector<Job>& jobs) {
  const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const Job& j) { return j.id == request.job; });
  if (job == jobs.end()) throw std::runtime_error(request.experiment.string() + ": has no run '" + request.job + "'");
  const DirectoryLock lock(request.directory, DirectoryLock::Kind::shared);
  JobRunner runner = runnerOf(request, experiment);
  const std::string reason = runner.isDone(*job) ? "" : runner.run(*job);
  if (reason.empty()) return exit_done;
  std::cerr << "vmcl evaluate: " << job->id << ": " << reason << '\n';
  return exit_failed;
}

void runMissingJobs(const EvaluateRequest& request, const Experiment& experiment, const std::vector<Job>& jobs) {
  JobRunner runner = runnerOf(request, experiment);
  if (!request.resume && runner.hasResults())
    throw std::runtime_error(request.directory.string() + ": holds results already: --resume goes on with them");
  runner.removeUnfinished();
  std::vector<Job> missing;
  std::copy_if(jobs.begin(), jobs.end(), std::back_inserter(missing),
               [&](const Job& job) { return !runner.isDone(job); });
  runner.writeJobList(jobs);
  ProgressBar bar;
  runner.run(missing, request.workers, [&](std::size_t ended) {
    bar.update("evaluating", static_cast<double>(ended) / static_cast<double>(missing.size()));
  });
}

int exitCodeOf(const ReportSummary& summary) {
  if (summary.done == 0) return exit_failed;
  return summary.failed.empty() && summary.missing == 0 && summary.with_problems.empty() ? exit_done
                                                                                         : exit_some_input_bad;
}

int report(const EvaluateRequest& request, const Experiment& experiment, const ExperimentPlan& plan) {
  const ReportSummary summary = writeReport(experiment, plan, request.directory, VMCL_VERSION);
  for (const auto* runs : {&summary.failed, &summary.with_problems})
    for (const FailedRun& run : *runs) std::cerr << "vmcl evaluate: " << run.id << ": " << run.reason << '\n';
  if (summary.missing > 0) std::cerr << "vmcl evaluate: " << summary.missing << " runs have not been made yet\n";
  for (const SkippedCombination& skipped : plan.skipped)
    std::cout << "skipped " << skipped.name << ": " << skipped.reason << '\n';
  std::cout << summary.done << " of " << plan.jobs.size()
            << " runs done: " << (request.directory / "report.html").string() << '\n';
  return exitCodeOf(summary);
}

int evaluate(const EvaluateRequest& request) {
  const Experiment experiment = readExperiment(request.experiment);
  const ExperimentPlan plan = planExperiment(experiment);
  if (request.list) return listJobs(request, experiment, plan.jobs);
  if (!request.job.empty()) return runOneJob(request, experiment, plan.jobs);
  const DirectoryLock lock(request.directory, DirectoryLock::Kind::alone);
  if (request.report_only)
    runnerOf(request, experiment).removeUnfinished();
  else
    runMissingJobs(request, experiment, plan.jobs);
  return report(request, experiment, plan);
}

}  // namespace

void addEvaluateVerb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "evaluate",
      "Localize many logs with many settings and seeds, each run in a process of its own, and report: tables\n"
      "(results.csv, results.md, runs.csv, costs.csv) and a page with pictures (report.html).");
  const auto request = std::make_shared<EvaluateRequest>();
  verb->add_option("EXPERIMENT", request->experiment, "What to run (YAML)")->required();
  verb->add_option("-o,--output", request->directory, "Directory for results and report")->required();
  verb->add_option("--workers", request->workers, "Runs at once; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("one a processor");
  auto* resume = verb->add_flag("--resume", request->resume,
                                "Go on with what is in the directory: make the runs that are missing or failed");
  auto* list = verb->add_flag("--list", request->list, "Only print the names of the runs, and write jobs.jsonl");
  auto* job =
      verb->add_option("--job", request->job, "Only make this run, unless it is done: for clusters, see share/cluster");
  auto* report_only = verb->add_flag("--report-only", request->report_only, "Only report on the runs that there are");
  for (CLI::Option* option : {resume, list, job, report_only})
    for (CLI::Option* other : {resume, list, job, report_only})
      if (option != other) option->excludes(other);
  verb->footer(
      "Example:\n"
      "  vmcl evaluate share/experiments/rooms.yaml -o result\n"
      "The file lists what is combined with what:\n"
      "  rawlogs: [{rawlog: query.rawlog, maps: [rooms.vmap, rooms.simplemap], ground_truth: query.groundtruth.tum}]\n"
      "  sensors: [camera, laser, both, odometry]\n"
      "  configurations: [{name: few, ini: both.ini, changes: {LocalizationExperiment: {particles_count: 500}}}]\n"
      "  starts: [given, global]\n"
      "  kidnappings: [{at: 10, skip: 5}]   # s: carried off at 10 s, seeing again 5 s later\n"
      "  seeds: 20                          # 1 to 20");
  verb->callback([request, &exit_code] { exit_code = evaluate(*request); });
}

}  // namespace vmcl

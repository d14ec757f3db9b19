// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <thread>

#include "ordered_parallel.h"
#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/evaluation/study_report.h"

namespace vmcl {
namespace {

struct BenchOptions {
  std::filesystem::path output;
  int trials = 30;
  uint64_t seed = 1;
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<Figure> figures{Figure::accuracy, Figure::success, Figure::tilt, Figure::cost_of_matches,
                              Figure::cost_of_cameras};
};

bool isAboutTime(const StudyCell& cell) {
  return cell.figure == Figure::cost_of_matches || cell.figure == Figure::cost_of_cameras;
}

CellSummary runCell(const StudyCell& cell, const BenchOptions& options) {
  const std::vector<PoseMethod> methods = methodsOf(cell);
  constexpr int enough_for_times = 11;
  const int trials = isAboutTime(cell) ? std::min(options.trials, enough_for_times) : options.trials;
  const int threads = isAboutTime(cell) ? 1 : options.threads;  // trials side by side slow each other down
  std::vector<TrialResult> results;
  int trial = 0;
  const auto next = [&](int& job) {
    job = trial++;
    return job < trials;
  };
  orderedParallel<int, TrialResult>(
      threads, next, [&](int job) { return runTrial(cell, methods, options.seed, job); },
      [&](const TrialResult& result) { results.push_back(result); });
  return {cell, summarize(methods, results)};
}

/// What a reader must know to compare fairly.
void printMethods(std::ostream& out) {
  for (const PoseMethod& method : poseMethods()) out << method.name << ": " << method.description << '\n';
  const PoseMethod soft = softPlaneMethod();
  out << soft.name << ": " << soft.description << '\n'
      << bound_name << ": the likelihood optimized from the true pose\n"
      << cramer_rao_name << ": what the best unbiased estimator that knew the inliers could reach\n";
  out << "Matches without depth help vmcl and 1P1DP alone: the other methods have no use for them. AP3P, EPnP, MAGSAC "
         "and\n"
      << "P3P take part with one camera only. Poses with six degrees of freedom are cut down to x, y and heading.\n";
  if (!hasOpenGv()) out << "P3P, GP3P, UPnP: absent, vmcl was built without OpenGV\n";
}

int run(const BenchOptions& options) {
  std::filesystem::create_directories(options.output);
  const std::vector<StudyCell> cells = studyCells(options.figures);
  StudyRun study{options.seed, options.trials, {}};
  ProgressBar progress;
  for (const StudyCell& cell : cells) {
    progress.update(nameOf(cell.figure), static_cast<double>(study.cells.size()) / static_cast<double>(cells.size()));
    study.cells.push_back(runCell(cell, options));
  }
  writeStudyTables(options.output, study);
  printMethods(std::cout);
  printStudy(std::cout, study);
  drawStudy(options.output, study);
  return exit_done;
}

}  // namespace

void addBenchVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* verb = app.add_subcommand("bench", "Repeat the simulation study of the paper, beside other methods");
  static const std::map<std::string, std::vector<Figure>> figures{{"all", options->figures},
                                                                  {"accuracy", {Figure::accuracy}},
                                                                  {"success", {Figure::success}},
                                                                  {"tilt", {Figure::tilt}},
                                                                  {"cost-matches", {Figure::cost_of_matches}},
                                                                  {"cost-cameras", {Figure::cost_of_cameras}}};
  verb->add_option("-o,--output", options->output, "directory for tables and pictures")->required();
  verb->add_option("--trials", options->trials, "simulated problems of each cell of a figure; 200 for sharp intervals")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  const auto choose = [options](const std::vector<std::string>& names) {
    options->figures.clear();
    for (const std::string& name : names)
      for (const Figure figure : figures.at(name)) options->figures.push_back(figure);
  };
  verb->add_option_function<std::vector<std::string>>("--figures", choose, "those to repeat, separated by commas")
      ->check(CLI::IsMember(figures))
      ->delimiter(',')
      ->default_str("all");
  verb->add_option("--seed", options->seed, "same seed, same results but for the times")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--threads", options->threads, "trials worked on at once; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("one a processor");
  verb->footer(
      "Example: vmcl bench -o study --trials 200 --figures accuracy,success\n"
      "Writes results.csv, summary.json, timings.csv and a picture (SVG) for each figure; prints the tables.");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vmcl

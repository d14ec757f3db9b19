// SPDX-License-Identifier: BSD-3-Clause
#include "experiment_tables.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

/// As a field of a CSV file.
std::string quotedField(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void writeResults(const std::filesystem::path& file, const ExperimentResults& results) {
  AtomicFile csv(file);
  std::ostream& out = csv.stream();
  out << "rawlog,start,sensors,configuration,done,failed,missing";
  for (const Measure& measure : resultMeasures())
    out << ',' << measure.key << ',' << measure.key << "_low," << measure.key << "_high," << measure.key << "_runs";
  out << '\n' << std::setprecision(6);
  const Experiment& experiment = results.experiment;
  for (const Cell& cell : cellsOf(results)) {
    out << experiment.sessions[cell.session].name << ',' << experiment.starts[cell.start].name << ','
        << nameOf(cell.method.sensors) << ',' << experiment.configurations[cell.method.configuration].name << ','
        << cell.done.size() << ',' << cell.failed << ',' << cell.missing;
    for (const Measure& measure : resultMeasures()) {
      if (const auto summary = summarize(measure, cell))
        out << ',' << summary->value << ',' << summary->interval.low << ',' << summary->interval.high << ','
            << summary->runs;
      else
        out << ",,,,0";
    }
    out << '\n';
  }
  csv.commit();
}

void writeRuns(const std::filesystem::path& file, const ExperimentResults& results,
               const std::vector<Measure>& measures) {
  AtomicFile csv(file);
  std::ostream& out = csv.stream();
  out << "run,status,reason";
  for (const Measure& measure : measures) out << ',' << measure.key;
  out << '\n' << std::setprecision(6);
  for (const RunResult& run : results.runs) {
    out << run.job.id << ','
        << (run.end.done    ? "done"
            : run.end.there ? "failed"
                            : "missing")
        << ',' << quotedField(run.end.reason);
    for (const Measure& measure : measures) {
      out << ',';
      if (!run.end.done) continue;
      if (const auto value = measure.of(run)) out << *value;
    }
    out << '\n';
  }
  csv.commit();
}

void writeMarkdownTable(std::ostream& out, const ExperimentResults& results, const CellGroup& group) {
  out << "\n## " << titleOf(results, group) << "\n\n|  |";
  for (const Cell& cell : group.cells) out << ' ' << nameOf(results.experiment, cell.method) << " |";
  out << "\n|---|";
  for (std::size_t i = 0; i < group.cells.size(); ++i) out << "---|";
  out << "\n| runs (failed) |";
  for (const Cell& cell : group.cells) out << ' ' << cell.done.size() << " (" << cell.failed << ") |";
  out << '\n';
  for (const Measure& measure : measuresIn(group, resultMeasures())) {
    out << "| " << measure.title << (measure.unit.empty() ? "" : " [" + measure.unit + ']') << " |";
    for (const Cell& cell : group.cells) out << ' ' << textOf(measure, summarize(measure, cell)) << " |";
    out << '\n';
  }
}

void writeMarkdown(const std::filesystem::path& file, const ExperimentResults& results) {
  AtomicFile markdown(file);
  markdown.stream() << "# " << results.experiment.file.stem().string()
                    << "\n\nRates with Wilson's, means and medians over the runs with bootstrap 95 % intervals.\n";
  for (const CellGroup& group : groupsOf(results)) writeMarkdownTable(markdown.stream(), results, group);
  markdown.commit();
}

}  // namespace

std::vector<CellGroup> groupsOf(const ExperimentResults& results) {
  std::vector<CellGroup> groups;
  for (Cell& cell : cellsOf(results)) {
    if (groups.empty() || groups.back().session != cell.session || groups.back().start != cell.start)
      groups.push_back({cell.session, cell.start, {}});
    groups.back().cells.push_back(std::move(cell));
  }
  return groups;
}

std::string titleOf(const ExperimentResults& results, const CellGroup& group) {
  const Start& start = results.experiment.starts[group.start];
  std::ostringstream title;
  title << results.experiment.sessions[group.session].name << ", ";
  if (!start.kidnapping) {
    title << start.name << " start";
  } else {
    title << "kidnapped at " << start.kidnapping->at << " s for " << start.kidnapping->skip << " s";
    if (start.after > 0) title << ", started after " << start.after << " s";
  }
  return title.str();
}

std::vector<Measure> measuresIn(const CellGroup& group, const std::vector<Measure>& measures) {
  std::vector<Measure> present;
  std::copy_if(measures.begin(), measures.end(), std::back_inserter(present), [&](const Measure& measure) {
    return std::any_of(group.cells.begin(), group.cells.end(),
                       [&](const Cell& cell) { return summarize(measure, cell).has_value(); });
  });
  return present;
}

void writeTables(const std::filesystem::path& directory, const ExperimentResults& results) {
  writeResults(directory / "results.csv", results);
  writeMarkdown(directory / "results.md", results);
  writeRuns(directory / "runs.csv", results, resultMeasures());
  writeRuns(directory / "costs.csv", results, costMeasures());
}

}  // namespace vmcl

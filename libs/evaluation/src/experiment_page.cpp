// SPDX-License-Identifier: BSD-3-Clause
#include "experiment_page.h"

#include <mrpt/system/os.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "experiment_plots.h"
#include "experiment_tables.h"
#include "html.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mrpt/localization_config.h"

namespace vmcl {
namespace {

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The maps of the group's sensors: of both, if they are compared.
std::vector<PlotLayer> mapOf(const Experiment& experiment, const CellGroup& group) {
  auto cell = std::find_if(group.cells.begin(), group.cells.end(),
                           [](const Cell& c) { return c.method.sensors == Sensors::both; });
  if (cell == group.cells.end()) cell = group.cells.begin();
  const ExperimentSession& session = experiment.sessions[group.session];
  const Configuration& configuration = experiment.configurations[cell->method.configuration];
  return mapLayers(*loadMaps(loadLocalizationConfig(configuration.ini, session.maps, session.rawlog,
                                                    {configuration.changes, cell->method.sensors})));
}

std::string anchorOf(std::size_t group) { return std::string("g").append(std::to_string(group)); }

/// Measures down, methods across.
void writeGroupTable(std::ostream& out, const ExperimentResults& results, const CellGroup& group) {
  out << "<table><thead><tr><th></th>";
  for (const Cell& cell : group.cells) out << "<th>" << escaped(nameOf(results.experiment, cell.method)) << "</th>";
  out << "</tr></thead>\n<tr><td>runs</td>";
  for (const Cell& cell : group.cells) {
    out << "<td>" << cell.done.size();
    if (cell.failed > 0) out << " <em>" << cell.failed << " failed</em>";
    if (cell.missing > 0) out << " <em>" << cell.missing << " missing</em>";
    out << "</td>";
  }
  out << "</tr>\n";
  for (const auto* measures : {&resultMeasures(), &costMeasures()})
    for (const Measure& measure : measuresIn(group, *measures)) {
      out << "<tr><td>" << escaped(measure.title)
          << (measure.unit.empty() ? "" : " <span>" + escaped(measure.unit) + "</span>") << "</td>";
      for (const Cell& cell : group.cells) {
        const std::string text = textOf(measure, summarize(measure, cell));
        const auto space = text.find(' ');
        out << "<td>" << text.substr(0, space);
        if (space != std::string::npos) out << "<small>" << text.substr(space) << "</small>";
        out << "</td>";
      }
      out << "</tr>\n";
    }
  out << "</table>\n";
}

/// The figures that tell most, all groups and methods below each other.
void writeOverview(std::ostream& out, const ExperimentResults& results, const std::vector<CellGroup>& groups) {
  std::vector<Measure> measures;
  for (const char* key : {"converged", "time_to_converge_s", "position_rmse_m", "heading_rmse_deg", "success_025",
                          "false_accept_share", "recovered", "recovery_time_s"})
    for (const Measure& measure : resultMeasures())
      if (measure.key == key && std::any_of(groups.begin(), groups.end(), [&](const CellGroup& group) {
            return !measuresIn(group, {measure}).empty();
          }))
        measures.push_back(measure);
  out << "<table class=overview><thead><tr><th></th><th></th><th>runs</th>";
  for (const Measure& measure : measures)
    out << "<th>" << escaped(measure.title) << (measure.unit.empty() ? "" : " <span>" + measure.unit + "</span>")
        << "</th>";
  out << "</tr></thead>\n";
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Cell& cell : groups[g].cells) {
      const bool first = &cell == &groups[g].cells.front();
      out << (first ? "<tr class=first>" : "<tr>") << "<td>"
          << (first ? "<a href='#" + anchorOf(g) + "'>" + escaped(titleOf(results, groups[g])) + "</a>" : "")
          << "</td><td>" << escaped(nameOf(results.experiment, cell.method)) << "</td><td>" << cell.done.size()
          << "</td>";
      for (const Measure& measure : measures) {
        const std::string text = textOf(measure, summarize(measure, cell));
        out << "<td>" << text.substr(0, text.find(' ')) << "</td>";
      }
      out << "</tr>\n";
    }
  out << "</table>\n";
}

void writeGroup(std::ostream& out, const std::filesystem::path& directory, const ExperimentResults& results,
                const CellGroup& group, const std::string& anchor, const std::vector<PlotLayer>& map) {
  out << "<h2 id='" << anchor << "'>" << escaped(titleOf(results, group)) << "</h2>\n";
  writeGroupTable(out, results, group);
  int number = 0;
  for (const GroupPicture& picture : drawGroup(directory, results, group, map))
    out << "<figure>" << inlineSvg(contentOf(picture.svg), anchor + "p" + std::to_string(number++)) << "<figcaption>"
        << escaped(picture.caption) << ".</figcaption></figure>\n";
}

void writeWhatWasRun(std::ostream& out, const ExperimentResults& results, const std::string& version) {
  const Experiment& experiment = results.experiment;
  JobDescriber describer(experiment);
  out << "<h2>What was run</h2>\n<p>vmcl " << escaped(version) << ", " << escaped(mrpt::system::MRPT_getVersion())
      << "; " << results.plan.jobs.size() << " runs, seeds 1 to " << experiment.seeds
      << ". Each combination's first run, with the hash of all that decides on its result:</p>\n<table class=words>\n";
  for (const Job& job : results.plan.jobs)
    if (job.seed == 1) {
      out << "<tr><td><code>" << describer.hashOf(job) << "</code></td><td><code>vmcl";
      for (const std::string& word : commandOf(experiment, job)) out << ' ' << escaped(shellWord(word));
      out << "</code></td></tr>\n";
    }
  out << "</table>\n<p>To repeat all of it, with this file:</p>\n<pre>vmcl evaluate "
      << escaped(shellWord(experiment.file.string())) << " -o DIRECTORY</pre>\n<pre>"
      << escaped(contentOf(experiment.file)) << "</pre>\n";
}

using NamedReasons = std::vector<std::pair<std::string, std::string>>;

void writeReasons(std::ostream& out, const std::string& title, const NamedReasons& reasons) {
  if (reasons.empty()) return;
  out << "<h2>" << title << "</h2>\n<table class=words>\n";
  for (const auto& [name, reason] : reasons)
    out << "<tr><td>" << escaped(name) << "</td><td>" << escaped(reason) << "</td></tr>\n";
  out << "</table>\n";
}

void writeWhatWentWrong(std::ostream& out, const ExperimentResults& results) {
  NamedReasons failures, problems, skipped;
  for (const RunResult& run : results.runs) {
    if (!run.end.reason.empty()) failures.emplace_back(run.job.id, run.end.reason);
    for (const std::string& problem : run.end.problems) problems.emplace_back(run.job.id, problem);
  }
  for (const SkippedCombination& combination : results.plan.skipped)
    skipped.emplace_back(combination.name, combination.reason);
  writeReasons(out, "Runs that failed", failures);
  writeReasons(out, "Runs with problems of their input", problems);
  writeReasons(out, "Combinations that make no sense", skipped);
}

}  // namespace

void writePage(const std::filesystem::path& directory, const ExperimentResults& results, const std::string& version) {
  const std::vector<CellGroup> groups = groupsOf(results);
  AtomicFile page(directory / "report.html");
  std::ostream& out = page.stream();
  writePageHead(out, results.experiment.file.stem().string());
  out << "<p>Rates with Wilson's 95 % intervals; means and medians over the runs with bootstrap 95 % intervals in "
         "parentheses. Nothing is aligned: the map frame is given.</p>\n";
  writeOverview(out, results, groups);
  std::map<std::size_t, std::vector<PlotLayer>> maps;  // by session
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CellGroup& group = groups[g];
    if (!maps.contains(group.session)) maps[group.session] = mapOf(results.experiment, group);
    writeGroup(out, directory, results, group, anchorOf(g), maps[group.session]);
  }
  writeWhatWentWrong(out, results);
  writeWhatWasRun(out, results, version);
  out << "</main></body></html>\n";
  page.commit();
}

}  // namespace vmcl

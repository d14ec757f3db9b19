// SPDX-License-Identifier: BSD-3-Clause
#include "experiment_plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "error_curves.h"
#include "gnuplot.h"

namespace vmcl {
namespace {

/// Colours that the colour-blind tell apart (Okabe and Ito 2008), after the others with dashes.
std::string lineStyle(std::size_t cell) {
  static constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
  return "lc rgb '" + std::string(colours[cell % colours.size()]) + "' dt " + std::to_string(1 + cell / colours.size());
}

std::string titleOfCell(const ExperimentResults& results, const CellGroup& group, std::size_t cell) {
  return " title '" + nameOf(results.experiment, group.cells[cell].method) + '\'';
}

constexpr const char* plain_axes =
    "set termoption noenhanced\nset grid lc rgb '#dddddd'\nset border 3 lc rgb '#666666'\nset tics nomirror\n";

/// The truth, and the first run of each method while localized.
std::vector<PlotLayer> pathsOf(const ExperimentResults& results, const CellGroup& group) {
  std::vector<PlotLayer> paths;
  paths.push_back(groundTruthLayer(results.ground_truths[group.session]));
  paths.back().style = "with lines lw 7 lc rgb '#f3dc7a'";  // the paths lie on it
  for (std::size_t c = 0; c < group.cells.size(); ++c) {
    if (group.cells[c].done.empty()) continue;
    std::vector<TimedEstimate> estimates;
    for (const RunUpdate& update : group.cells[c].done.front()->updates) estimates.push_back(update.estimate);
    paths.push_back(
        pathLayer(nameOf(results.experiment, group.cells[c].method), "with lines lw 1.5 " + lineStyle(c), estimates));
  }
  std::erase_if(paths, [](const PlotLayer& layer) { return layer.empty(); });
  return paths;
}

std::string pathsCommands(const std::vector<PlotLayer>& paths, const std::vector<PlotLayer>& map) {
  std::ostringstream commands;
  writeData(commands, "map", map);
  writeData(commands, "path", paths);
  commands << plain_axes << rangesOf(viewOf(paths))
           << "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset key outside\nplot " << plotOf("map", map)
           << (map.empty() ? "" : ", ") << plotOf("path", paths) << '\n';
  return commands.str();
}

/// Median and quartiles over the runs.
std::string errorCommands(const ExperimentResults& results, const CellGroup& group, const ErrorGrid& grid) {
  constexpr double least = 1e-4;  // on a logarithmic axis
  std::ostringstream commands;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    commands << "$curve" << c << " << END\n";
    for (const ErrorQuartiles& at : quartilesOverTime(grid, c)) {
      commands << at.time;
      for (const double error : at.position) commands << ' ' << std::max(error, least);
      for (const double error : at.heading) commands << ' ' << std::max(error / degree, least);
      commands << '\n';
    }
    commands << "END\n";
  }
  commands << plain_axes << "set logscale y\nset multiplot layout 2,1 margins 0.1,0.83,0.12,0.97 spacing 0.1,0.09\n";
  const auto panel = [&](const char* label, int column) {
    commands << "set ylabel '" << label << "'\nplot ";
    for (std::size_t c = 0; c < grid.cells.size(); ++c) {
      if (quartilesOverTime(grid, c).empty()) continue;
      commands << "$curve" << c << " using 1:" << column << ':' << column + 2
               << " with filledcurves fs transparent solid 0.2 "
               << "noborder " << lineStyle(c) << " notitle, $curve" << c << " using 1:" << column + 1
               << " with lines lw 2 " << lineStyle(c) << titleOfCell(results, group, c) << ", ";
    }
    commands << "NaN notitle\n";
  };
  commands << "set key outside\n";
  panel("position error [m]", 2);
  commands << "set key off\nset xlabel 'time [s]'\n";
  panel("heading error [deg]", 5);
  return commands.str();
}

std::string successCommands(const ExperimentResults& results, const CellGroup& group, const ErrorGrid& grid) {
  constexpr int steps = 60;
  constexpr double least = 0.01, most = 2;  // m
  std::ostringstream commands;
  commands << "$rates << END\n";
  for (int i = 0; i <= steps; ++i) {
    const double distance = least * std::pow(most / least, static_cast<double>(i) / steps);
    const SuccessRates rates = successRates(grid, distance);
    commands << distance;
    for (const auto* shares : {&rates.absolute, &rates.normalized})
      for (const double share : *shares) commands << ' ' << share;
    commands << '\n';
  }
  commands << "END\n"
           << plain_axes << "set yrange [0:1.02]\nset logscale x\nset xrange [" << least << ':' << most
           << "]\nset xlabel 'threshold [m], with 5 deg'\n";
  for (const double distance : success_distances)
    commands << "set arrow from " << distance << ",0 to " << distance << ",1.02 nohead dt 2 lc rgb '#999999'\n";
  const bool compares = grid.cells.size() > 1;  // else the method is the best of them at all times
  commands << "set multiplot layout 1," << (compares ? 2 : 1) << " margins 0.07,0.83,0.17,0.9 spacing 0.09,0.1\n";
  const auto panel = [&](const char* title, std::size_t first) {
    commands << "set title '" << title << "'\nplot ";
    for (std::size_t c = 0; c < grid.cells.size(); ++c)
      commands << (c ? ", " : "") << "$rates using 1:" << first + c << " with lines lw 2 " << lineStyle(c)
               << titleOfCell(results, group, c);
    commands << '\n';
  };
  commands << "set key off\n";
  panel("success rate", 2);
  commands << "set key at screen 0.99,0.9 right top\n";
  if (compares) panel("over that of the best at each time", 2 + grid.cells.size());
  return commands.str();
}

/// A title in two lines of gnuplot's, if it is about two things.
std::string brokenInTwo(std::string title) {
  if (const auto comma = title.find(", "); comma != std::string::npos) title.replace(comma, 2, "\\n");
  return title;
}

/// A box a method for each of some measures.
std::string boxCommands(const ExperimentResults& results, const CellGroup& group) {
  std::vector<Measure> measures;
  for (const char* key :
       {"position_rmse_m", "heading_rmse_deg", "time_to_converge_s", "recovery_time_s", "latency_p95_ms"})
    for (const auto* all : {&resultMeasures(), &costMeasures()})
      for (const Measure& measure : measuresIn(group, *all))
        if (measure.key == key) measures.push_back(measure);
  std::ostringstream commands;
  commands << plain_axes
           << "set key off\nset style fill solid 0.25 border\nset style boxplot outliers pt 6\nset yrange [0:*]\nset "
              "offsets 0,0,graph 0.05,0\n"
           << "set xtics rotate by -30 (";
  for (std::size_t c = 0; c < group.cells.size(); ++c)
    commands << (c ? ", '" : "'") << nameOf(results.experiment, group.cells[c].method) << "' " << c;
  commands << ")\nset xrange [-0.7:" << static_cast<double>(group.cells.size()) - 0.3 << "]\nset multiplot layout 1,"
           << measures.size() << " margins 0.06,0.97,0.22,0.85 spacing 0.065,0.1\n";
  for (const Measure& measure : measures) {
    for (std::size_t c = 0; c < group.cells.size(); ++c) {
      commands << "$box" << c << " << END\n";
      for (const RunResult* run : group.cells[c].done)
        if (const auto value = measure.of(*run)) commands << *value << '\n';
      commands << "END\n";
    }
    commands << "set title \"" << brokenInTwo(measure.title) << " [" << measure.unit << "]\" font ',12'\nplot ";
    for (std::size_t c = 0; c < group.cells.size(); ++c)
      if (summarize(measure, group.cells[c]))
        commands << "$box" << c << " using (" << c << "):1:(0.5) with boxplot lw 1.5 " << lineStyle(c) << ", ";
    commands << "NaN\n";
  }
  return commands.str();
}

}  // namespace

std::vector<GroupPicture> drawGroup(const std::filesystem::path& directory, const ExperimentResults& results,
                                    const CellGroup& group, const std::vector<PlotLayer>& map) {
  const ErrorGrid grid = errorGridOf(group);
  if (grid.times.empty()) return {};
  const Experiment& experiment = results.experiment;
  const std::string stem = experiment.sessions[group.session].name + '.' + experiment.starts[group.start].name;
  std::vector<GroupPicture> pictures;
  const auto draw = [&](const std::string& name, const std::string& size, const std::string& commands,
                        const std::string& caption) {
    const std::filesystem::path svg = directory / "plots" / (stem + '.' + name + ".svg");
    drawSvg(svg, size, commands);
    pictures.push_back({svg, caption});
  };
  std::filesystem::create_directories(directory / "plots");
  const std::vector<PlotLayer> paths = pathsOf(results, group);
  draw("paths", "1000," + std::to_string(heightOf(viewOf(paths), 1000)), pathsCommands(paths, map),
       "Paths over the map, first seed of each method, while localized");
  draw("errors", "1000,560", errorCommands(results, group, grid),
       "Errors over time: median and quartiles over the runs, localized or not");
  draw("success", "1000,420", successCommands(results, group, grid),
       std::string("Success against threshold, at all times and of all seeds, localized or not") +
           (grid.cells.size() > 1 ? ". Right: over the rate that always picking the best of the methods would reach"
                                  : ""));
  draw("boxes", "1000,380", boxCommands(results, group),
       "Over the runs: median, quartiles, whiskers of 1.5 times their distance");
  return pictures;
}

}  // namespace vmcl

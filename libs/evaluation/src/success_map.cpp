// SPDX-License-Identifier: BSD-3-Clause
#include "success_map.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "gnuplot.h"

namespace vmcl {
namespace {

constexpr int columns = 4;

/// The different values along an axis, increasing.
std::vector<double> valuesOf(const StudyPicture& cells, double WorldSettings::*setting) {
  std::vector<double> values;
  for (const CellSummary* cell : cells) values.push_back(cell->cell.world.*setting);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// An axis with a place for each of the values.
std::string axisOf(char axis, const std::string& label, const std::vector<double>& values) {
  std::ostringstream settings;
  settings << "set " << axis << "tics ";
  for (std::size_t i = 0; i < values.size(); ++i) settings << (i ? ", '" : "('") << values[i] << "' " << i;
  settings << ")\nset " << axis << "range [-0.5:" << static_cast<double>(values.size()) - 0.5 << "]\nset " << axis
           << "label '" << label << "' offset " << (axis == 'x' ? "0,0.6" : "1,0") << '\n';
  return settings.str();
}

/// A map of one method.
struct Panel {
  std::string title;
  std::size_t row;                ///< of the method among the rows of a cell
  int MethodSummary::*successes;  ///< what it shows
};

std::vector<Panel> panelsOf(const StudyPicture& cells) {
  std::vector<Panel> panels;
  const std::vector<MethodSummary>& rows = cells.front()->rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].method == cramer_rao_name) continue;
    panels.push_back({rows[i].method, i, &MethodSummary::successes});
    if (i == 0) panels.push_back({rows[i].method + ", best of its modes", i, &MethodSummary::any_successes});
  }
  return panels;
}

/// Lines of: column, row, rate, its text and its interval's.
std::string dataOf(const StudyPicture& cells, const Panel& panel, const std::vector<double>& outlier_rates,
                   const std::vector<double>& depth_rates) {
  std::ostringstream data;
  data << std::fixed << std::setprecision(2);
  const auto indexOf = [](const std::vector<double>& values, double value) {
    return std::find(values.begin(), values.end(), value) - values.begin();
  };
  for (const CellSummary* cell : cells) {
    const MethodSummary& row = cell->rows[panel.row];
    const int successes = row.*panel.successes;
    const Interval interval = wilsonInterval(successes, row.trials);
    const double rate = static_cast<double>(successes) / row.trials;
    data << indexOf(outlier_rates, cell->cell.world.outlier_rate) << ' '
         << indexOf(depth_rates, cell->cell.world.depth_rate) << ' ' << rate << " \"" << rate << "\" \"" << interval.low
         << "-" << interval.high << "\"\n";
  }
  return data.str();
}

/// A column of $map as text in the cells, white on dark ones.
std::string labels(int column, double offset, int font_size) {
  std::ostringstream plot;
  for (const char* condition : {"<", ">="})
    plot << ", $map using ($3 " << condition << " 0.6 ? $1 : 1/0):2:" << column << " with labels offset 0," << offset
         << " font '," << font_size << "' tc rgb '" << (*condition == '<' ? "white" : "black") << "' notitle";
  return plot.str();
}

}  // namespace

void drawSuccessMaps(const std::filesystem::path& directory, const StudyPicture& cells) {
  const WorldSettings& world = cells.front()->cell.world;
  const std::vector<double> outlier_rates = valuesOf(cells, &WorldSettings::outlier_rate);
  const std::vector<double> depth_rates = valuesOf(cells, &WorldSettings::depth_rate);
  const std::vector<Panel> panels = panelsOf(cells);
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns, height = 60 + 270 * rows;

  std::ostringstream commands;
  commands << "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#fde725')\n"
           << "set cbrange [0:1]\nunset colorbox\nunset key\nset tics scale 0\n"
           << axisOf('x', "outlier rate", outlier_rates) << axisOf('y', "depth rate", depth_rates)
           << "set multiplot layout " << rows << ',' << columns << " margins 0.055,0.985," << 70.0 / height << ','
           << 1 - 75.0 / height << " spacing 0.055," << 105.0 / height << " title 'Success rate (within "
           << success_distance << " m and 1 deg) and its 95 % interval: world \"" << nameOf(world.world) << "\", "
           << camerasOf(world) << ", " << world.matches_per_camera << " matches each, " << world.noise_px
           << " px noise'\n";
  for (const Panel& panel : panels)
    commands << "$map << END\n"
             << dataOf(cells, panel, outlier_rates, depth_rates) << "END\nset title '" << panel.title
             << "' offset 0,-0.5\nplot $map using 1:2:3 with image pixels notitle" << labels(4, 0.5, 14)
             << labels(5, -0.6, 11) << '\n';
  const std::string name = "success_" + std::string(nameOf(world.world)) + '_' + fileSuffix(world) + ".svg";
  drawSvg(directory / name, "1300," + std::to_string(height), commands.str());
}

}  // namespace vmcl

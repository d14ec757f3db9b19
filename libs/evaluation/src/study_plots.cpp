// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "gnuplot.h"
#include "study_picture.h"
#include "success_map.h"

namespace vmcl {
namespace {

/// Colours that the colour-blind tell apart (Okabe and Ito 2008), each with a shape of its own.
std::string styleOf(const std::string& method) {
  struct Style {
    const char* method;
    const char* style;
  };
  static constexpr Style styles[] = {
      {"vmcl", "lc rgb '#0072B2' pt 7 lw 2.5"},          {"vmcl soft", "lc rgb '#0072B2' pt 12 lw 2.5 dt 2"},
      {"1P1DP", "lc rgb '#D55E00' pt 5 lw 1.5"},         {"2DP", "lc rgb '#E69F00' pt 9 lw 1.5"},
      {"AP3P", "lc rgb '#009E73' pt 11 lw 1.5"},         {"EPnP", "lc rgb '#CC79A7' pt 13 lw 1.5"},
      {"MAGSAC", "lc rgb '#56B4E9' pt 4 lw 1.5"},        {"P3P", "lc rgb '#808080' pt 6 lw 1.5"},
      {"GP3P", "lc rgb '#7A4F1E' pt 8 lw 1.5"},          {"UPnP", "lc rgb '#B8A000' pt 10 lw 1.5"},
      {bound_name, "lc rgb '#000000' pt 2 lw 1.5 dt 3"}, {cramer_rao_name, "lc rgb '#000000' lw 2"},
  };
  for (const Style& style : styles)
    if (style.method == method) return style.style;
  return "lc rgb '#404040' pt 1";
}

/// A value with the ends of its interval.
struct PlotPoint {
  double x, y, low, high;
};

struct Line {
  std::string method;
  std::vector<PlotPoint> points;
  bool has_interval = true;
};

struct Axes {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string more;  ///< further settings of gnuplot
};

/// Lines with error bars; the key names the methods.
void plotLines(std::ostream& out, const std::string& prefix, const Axes& axes, const std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out << '$' << prefix << i << " << END\n";
    for (const PlotPoint& p : lines[i].points) out << p.x << ' ' << p.y << ' ' << p.low << ' ' << p.high << '\n';
    out << "END\n";
  }
  out << "set title '" << axes.title << "'\nset xlabel '" << axes.x_label << "'\nset ylabel '" << axes.y_label << "'\n"
      << "set grid lc rgb '#dddddd'\nset logscale y\n"
      << axes.more << "plot ";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string data = (i ? ", $" : "$") + prefix + std::to_string(i), style = styleOf(lines[i].method);
    out << data << (lines[i].has_interval ? " with yerrorlines " : " with lines ") << style << " title '"
        << lines[i].method << '\'';
  }
  out << '\n';
}

using RowPoint = std::function<PlotPoint(double x, const MethodSummary& row)>;

/// One line a method. Methods are moved apart a little, so that their error bars stay readable: by `factor` each on a
/// logarithmic axis, by `shift` on a linear one.
std::vector<Line> linesOf(const StudyPicture& cells, const std::function<double(const WorldSettings&)>& place,
                          double shift, double factor, const RowPoint& point) {
  std::vector<Line> lines;
  for (std::size_t m = 0; m < cells.front()->rows.size(); ++m) {
    Line& line = lines.emplace_back();
    line.method = cells.front()->rows[m].method;
    line.has_interval = line.method != cramer_rao_name;
    const double offset =
        line.has_interval ? static_cast<double>(m) - 0.5 * static_cast<double>(cells.front()->rows.size() - 2) : 0;
    for (const CellSummary* cell : cells)
      line.points.push_back(point(place(cell->cell.world) * std::pow(factor, offset) + shift * offset, cell->rows[m]));
  }
  return lines;
}

PlotPoint errorPoint(double x, const ErrorSummary& errors, bool shown, double unit) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!shown) return {x, none, none, none};
  return {x, unit * errors.rms, unit * errors.rms_interval.low, unit * errors.rms_interval.high};
}

void drawAccuracy(const std::filesystem::path& directory, const StudyPicture& cells) {
  const WorldSettings& world = cells.front()->cell.world;
  const auto noise = [](const WorldSettings& w) { return w.noise_px; };
  // Without noise the bound is next to nothing, far below the others on a logarithmic axis.
  const auto shown = [](double x, const MethodSummary& row) {
    return row.answered > 0 && (row.method != cramer_rao_name || x > 0);
  };
  constexpr double shift = 0.03;
  std::ostringstream commands;
  commands << "set multiplot layout 1,2 margins 0.08,0.86,0.13,0.9 spacing 0.09,0.1 "
           << "title 'RMS error, 95 % bootstrap intervals (" << camerasOf(world)
           << ", no outliers, all matches with depth)'\nset xrange [-0.3:5.3]\nunset key\n";
  plotLines(commands, "position", {"", "image noise [px]", "position error, RMS [m]", ""},
            linesOf(cells, noise, shift, 1,
                    [&](double x, const MethodSummary& row) { return errorPoint(x, row.distance, shown(x, row), 1); }));
  commands << "set key at screen 0.99,0.9 right top vertical spacing 1.3\n";
  plotLines(commands, "heading", {"", "image noise [px]", "heading error, RMS [deg]", ""},
            linesOf(cells, noise, shift, 1, [&](double x, const MethodSummary& row) {
              return errorPoint(x, row.angle, shown(x, row), 1 / degree);
            }));
  drawSvg(directory / ("accuracy_" + fileSuffix(world) + ".svg"), "1300,560", commands.str());
}

void drawTilt(const std::filesystem::path& directory, const StudyPicture& cells) {
  const std::string world(nameOf(cells.front()->cell.world.world));
  std::vector<Line> lines = linesOf(
      cells, [](const WorldSettings& w) { return w.tilt / degree; }, 0.006, 1,
      [](double x, const MethodSummary& row) {
        const Interval interval = wilsonInterval(row.successes, row.trials);
        return PlotPoint{x, double(row.successes) / row.trials, interval.low, interval.high};
      });
  std::erase_if(lines, [](const Line& line) { return line.method == cramer_rao_name; });
  std::ostringstream commands;
  commands << "set key outside right top vertical spacing 1.3\n";
  plotLines(
      commands, "tilt",
      {"Success rate, 95 % Wilson intervals (world \"" + world + "\", 30 % outliers, half with depth)",
       "tilt of the robot [deg]", "success rate", "unset logscale y\nset yrange [0:1.02]\nset xrange [-0.05:1.05]\n"},
      lines);
  drawSvg(directory / ("tilt_" + world + ".svg"), "900,600", commands.str());
}

void drawCost(const std::filesystem::path& svg, const StudyPicture& cells, const Axes& axes,
              const std::function<double(const WorldSettings&)>& place, double shift, double factor) {
  std::ostringstream commands;
  commands << "set key outside right top vertical spacing 1.3\n";
  std::vector<Line> lines = linesOf(cells, place, shift, factor, [](double x, const MethodSummary& row) {
    return PlotPoint{x, 1e3 * row.seconds[1], 1e3 * row.seconds[0], 1e3 * row.seconds[2]};
  });
  std::erase_if(lines, [](const Line& line) { return line.method == cramer_rao_name || line.method == bound_name; });
  plotLines(commands, "cost", axes, lines);
  drawSvg(svg, "900,600", commands.str());
}

}  // namespace

void drawStudy(const std::filesystem::path& directory, const StudyRun& run) {
  for (const StudyPicture& picture : picturesOf(run, Figure::accuracy)) drawAccuracy(directory, picture);
  for (const StudyPicture& picture : picturesOf(run, Figure::success)) drawSuccessMaps(directory, picture);
  for (const StudyPicture& picture : picturesOf(run, Figure::tilt)) drawTilt(directory, picture);
  const char* const time = "processor time of an estimate [ms]";
  for (const StudyPicture& picture : picturesOf(run, Figure::cost_of_matches))
    drawCost(
        directory / "cost_matches.svg", picture,
        {"Median time and quartiles (1 camera, half outliers, half with depth)", "matches", time,
         "set logscale x\nset xrange [40:13000]\n"},
        [](const WorldSettings& world) { return world.matches_per_camera; }, 0, 1.02);
  for (const StudyPicture& picture : picturesOf(run, Figure::cost_of_cameras))
    drawCost(
        directory / "cost_cameras.svg", picture,
        {"Median time and quartiles (50 matches a camera, half outliers, half with depth)", "cameras", time,
         "set xrange [0.7:6.3]\nset xtics 1\n"},
        [](const WorldSettings& world) { return world.cameras; }, 0.02, 1);
}

}  // namespace vmcl

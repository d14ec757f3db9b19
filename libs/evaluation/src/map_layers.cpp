// SPDX-License-Identifier: BSD-3-Clause
#include "map_layers.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "gnuplot.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {
namespace {

/// As a line, which takes less room in a picture than a point.
void addDash(std::ostringstream& points, double from_x, double to_x, double y) {
  points << from_x << ' ' << y << '\n' << to_x << ' ' << y << "\n\n";
}

/// A box, as x, y and the limits of both, for the occupied cells that lie beside each other.
void addOccupiedCells(const mrpt::maps::COccupancyGridMap2D& grid, std::ostringstream& points) {
  constexpr float max_free_probability = 0.4F;
  const auto occupied = [&](int x, int y) {
    return x < static_cast<int>(grid.getSizeX()) && grid.getCell(x, y) < max_free_probability;
  };
  const double half_cell = 0.5 * grid.getResolution();
  for (int y = 0; y < static_cast<int>(grid.getSizeY()); ++y)
    for (int x = 0; x < static_cast<int>(grid.getSizeX()); ++x) {
      const int first = x;
      while (occupied(x, y)) ++x;
      const double from_x = grid.idx2x(first) - half_cell, to_x = grid.idx2x(x - 1) + half_cell, at_y = grid.idx2y(y);
      if (x > first)
        points << from_x << ' ' << at_y << ' ' << from_x << ' ' << to_x << ' ' << at_y - half_cell << ' '
               << at_y + half_cell << '\n';
    }
}

/// Where the keyframes were taken, and landmarks within a few metres of them: the rest are far or bad.
void addVisualMap(const KeyframeMap& map, std::ostringstream& landmarks, std::ostringstream& keyframes) {
  constexpr double reach = 4, half_dash = 0.01;  // m
  Eigen::AlignedBox2d area;
  for (const Keyframe& keyframe : map.keyframes) {
    const Eigen::Vector2d position = keyframe.map_from_robot.translation().head<2>();
    keyframes << position.x() << ' ' << position.y() << '\n';
    area.extend(position);
  }
  for (const Landmark& landmark : map.landmarks)
    if (const Eigen::Vector2d position = landmark.point_in_map.head<2>(); area.exteriorDistance(position) < reach)
      addDash(landmarks, position.x() - half_dash, position.x() + half_dash, position.y());
}

}  // namespace

void PlotLayer::addToPath(double x, double y) {
  points << x << ' ' << y << '\n';
  path_area.extend(Eigen::Vector2d(x, y));
}

std::vector<PlotLayer> mapLayers(const mrpt::maps::CMultiMetricMap& maps) {
  std::vector<PlotLayer> layers;
  layers.push_back({"occupied", "with boxxyerror fs solid lc rgb '#505050'", {}, {}});
  layers.push_back({"landmarks", "with lines lw 1.2 lc rgb '#a8a8a8'", {}, {}});
  layers.push_back({"keyframes", "with points pt 7 ps 0.4 lc rgb '#e0903a'", {}, {}});
  for (const auto& map : maps.maps) {
    if (const auto* grid = dynamic_cast<const mrpt::maps::COccupancyGridMap2D*>(map.get()))
      addOccupiedCells(*grid, layers[0].points);
    if (const auto* visual = dynamic_cast<const VisualKeyframeMap*>(map.get()); visual && visual->content())
      addVisualMap(*visual->content(), layers[1].points, layers[2].points);
  }
  std::erase_if(layers, [](const PlotLayer& layer) { return layer.empty(); });
  return layers;
}

PlotLayer groundTruthLayer(const Trajectory& ground_truth) {
  PlotLayer truth{"ground truth", "with lines lw 3 lc rgb '#2ca02c'", {}, {}};
  for (const StampedPose& pose : ground_truth.poses())
    truth.addToPath(pose.map_from_robot.translation().x(), pose.map_from_robot.translation().y());
  return truth;
}

PlotLayer pathLayer(const std::string& name, const std::string& style, const std::vector<TimedEstimate>& estimates) {
  PlotLayer path{name, style, {}, {}};
  for (const TimedEstimate& estimate : estimates)
    if (estimate.localized)
      path.addToPath(estimate.robot_in_map.x, estimate.robot_in_map.y);
    else
      path.points << '\n';
  return path;
}

Eigen::AlignedBox2d viewOf(const std::vector<PlotLayer>& layers) {
  constexpr double least_margin = 1, relative_margin = 0.15;  // m
  Eigen::AlignedBox2d view;
  for (const PlotLayer& layer : layers) view.extend(layer.path_area);
  if (view.isEmpty()) return view;
  const Eigen::Vector2d margin =
      Eigen::Vector2d::Constant(std::max(least_margin, relative_margin * view.sizes().maxCoeff()));
  return {view.min() - margin, view.max() + margin};
}

std::string rangesOf(const Eigen::AlignedBox2d& view) {
  if (view.isEmpty()) return "";
  std::ostringstream ranges;
  ranges << "set xrange [" << view.min().x() << ':' << view.max().x() << "]\nset yrange [" << view.min().y() << ':'
         << view.max().y() << "]\n";
  return ranges.str();
}

int heightOf(const Eigen::AlignedBox2d& view, int width) {
  constexpr double beside = 0.3, below = 90;  // the legend's share of the width; axis and labels, px
  const double aspect = view.isEmpty() ? 1 : view.sizes().y() / view.sizes().x();
  return static_cast<int>(below + (1 - beside) * width * std::clamp(aspect, 0.2, 1.2));
}

void writeData(std::ostream& script, const std::string& prefix, const std::vector<PlotLayer>& layers) {
  for (std::size_t i = 0; i < layers.size(); ++i)
    script << '$' << prefix << i << " << END\n" << layers[i].points.str() << "END\n";
}

std::string plotOf(const std::string& prefix, const std::vector<PlotLayer>& layers) {
  std::ostringstream plot;
  for (std::size_t i = 0; i < layers.size(); ++i)
    plot << (i ? ", $" : "$") << prefix << i << ' ' << layers[i].style << " title '" << layers[i].name << '\'';
  return plot.str();
}

void drawLayers(const std::filesystem::path& stem, const std::vector<PlotLayer>& layers) {
  AtomicFile script(stem.string() + ".gnuplot"), svg(stem.string() + ".svg"), png(stem.string() + ".png");
  const Eigen::AlignedBox2d view = viewOf(layers);
  constexpr int width = 900;
  const std::string size = std::to_string(width) + ',' + std::to_string(heightOf(view, width));
  writeData(script.stream(), "layer", layers);
  script.stream() << rangesOf(view)
                  << "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset grid lc rgb '#dddddd'\n"
                  << "set key outside\nset terminal svg size " << size << " background rgb 'white'\nset output "
                  << quoted(svg.temporaryPath()) << "\nplot " << plotOf("layer", layers)
                  << "\nset terminal pngcairo size " << size << "\nset output " << quoted(png.temporaryPath())
                  << "\nreplot\n";
  script.stream().flush();
  runGnuplot(script.temporaryPath(), stem.string() + ".svg");
  svg.commit();
  png.commit();
}

}  // namespace vmcl

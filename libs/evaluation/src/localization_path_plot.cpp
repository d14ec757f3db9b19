// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <sstream>

#include "gnuplot.h"
#include "vmcl/evaluation/localization_picture.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {
namespace {

/// A named block of points in a gnuplot script, with the way to draw it. An empty line breaks a path.
struct Layer {
  std::string name;
  std::string style;
  std::ostringstream points;
};

void addOccupiedCells(const mrpt::maps::COccupancyGridMap2D& grid, std::ostringstream& points) {
  constexpr float max_free_probability = 0.4F;
  for (unsigned x = 0; x < grid.getSizeX(); ++x)
    for (unsigned y = 0; y < grid.getSizeY(); ++y)
      if (grid.getCell(static_cast<int>(x), static_cast<int>(y)) < max_free_probability)
        points << grid.idx2x(x) << ' ' << grid.idx2y(y) << '\n';
}

/// Where the keyframes were taken, and landmarks within a few metres of them: the rest are far or bad.
void addVisualMap(const KeyframeMap& map, std::ostringstream& landmarks, std::ostringstream& keyframes) {
  constexpr double reach = 4;  // m
  Eigen::AlignedBox2d area;
  for (const Keyframe& keyframe : map.keyframes) {
    const Eigen::Vector2d position = keyframe.map_from_robot.translation().head<2>();
    keyframes << position.x() << ' ' << position.y() << '\n';
    area.extend(position);
  }
  for (const Landmark& landmark : map.landmarks)
    if (const Eigen::Vector2d position = landmark.point_in_map.head<2>(); area.exteriorDistance(position) < reach)
      landmarks << position.x() << ' ' << position.y() << '\n';
}

std::vector<Layer> layersOf(const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps) {
  std::vector<Layer> layers;
  Layer cells{"occupied", "with points pt 5 ps 0.25 lc rgb '#707070'", {}};
  Layer landmarks{"landmarks", "with points pt 7 ps 0.1 lc rgb '#909090'", {}};
  Layer keyframes{"keyframes", "with points pt 7 ps 0.3 lc rgb '#e0903a'", {}};
  for (const auto& map : maps.maps) {
    if (const auto* grid = dynamic_cast<const mrpt::maps::COccupancyGridMap2D*>(map.get()))
      addOccupiedCells(*grid, cells.points);
    if (const auto* visual = dynamic_cast<const VisualKeyframeMap*>(map.get()); visual && visual->content())
      addVisualMap(*visual->content(), landmarks.points, keyframes.points);
  }
  layers.push_back(std::move(cells));
  layers.push_back(std::move(landmarks));
  layers.push_back(std::move(keyframes));
  Layer truth{"ground truth", "with lines lw 3 lc rgb '#2ca02c'", {}};
  if (run.ground_truth)
    for (const StampedPose& pose : run.ground_truth->poses())
      truth.points << pose.map_from_robot.translation().x() << ' ' << pose.map_from_robot.translation().y() << '\n';
  layers.push_back(std::move(truth));
  Layer path{"localized", "with lines lw 2 lc rgb '#1f4fd8'", {}};
  Layer end{"end", "with points pt 7 ps 1 lc rgb '#d62728'", {}};
  for (const LocalizationFrame& frame : run.frames) {
    const PlanarPose& pose = frame.cluster.robot_in_map;
    if (frame.localized) path.points << pose.x << ' ' << pose.y;
    path.points << '\n';
  }
  if (!run.frames.empty() && run.frames.back().localized)
    end.points << run.frames.back().cluster.robot_in_map.x << ' ' << run.frames.back().cluster.robot_in_map.y << '\n';
  layers.push_back(std::move(path));
  layers.push_back(std::move(end));
  std::erase_if(layers, [](const Layer& l) { return l.points.str().find_first_not_of('\n') == std::string::npos; });
  return layers;
}

void writeScript(std::ostream& script, const std::vector<Layer>& layers, const std::filesystem::path& svg,
                 const std::filesystem::path& png) {
  for (std::size_t i = 0; i < layers.size(); ++i)
    script << "$layer" << i << " << END\n" << layers[i].points.str() << "END\n";
  script << "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset grid lc rgb '#dddddd'\nset key outside\n"
         << "set terminal svg size 900,700 background rgb 'white'\nset output " << quoted(svg) << "\nplot ";
  for (std::size_t i = 0; i < layers.size(); ++i)
    script << (i ? ", " : "") << "$layer" << i << ' ' << layers[i].style << " title '" << layers[i].name << '\'';
  script << "\nset terminal pngcairo size 900,700\nset output " << quoted(png) << "\nreplot\n";
}

}  // namespace

void drawPath(const std::filesystem::path& stem, const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps) {
  const std::vector<Layer> layers = layersOf(run, maps);
  if (layers.empty()) return;
  AtomicFile script(stem.string() + ".gnuplot"), svg(stem.string() + ".svg"), png(stem.string() + ".png");
  writeScript(script.stream(), layers, svg.temporaryPath(), png.temporaryPath());
  script.stream().flush();
  runGnuplot(script.temporaryPath(), stem.string() + ".svg");
  svg.commit();
  png.commit();
}

}  // namespace vmcl

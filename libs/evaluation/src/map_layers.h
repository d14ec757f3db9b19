// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "vmcl/evaluation/trajectory_error.h"

namespace vmcl {

/// Points in a gnuplot script, with the way to draw them. An empty line breaks a path.
struct PlotLayer {
  std::string name;
  std::string style;
  std::ostringstream points;
  Eigen::AlignedBox2d path_area;  ///< of the points, if they are a path

  void addToPath(double x, double y);
  bool empty() const { return points.str().find_first_not_of('\n') == std::string::npos; }
};

/// The maps seen from above: occupied cells, landmarks, keyframes; those that there are.
std::vector<PlotLayer> mapLayers(const mrpt::maps::CMultiMetricMap& maps);

PlotLayer groundTruthLayer(const Trajectory& ground_truth);

/// The poses while localized.
PlotLayer pathLayer(const std::string& name, const std::string& style, const std::vector<TimedEstimate>& estimates);

/// The paths among the layers and what is around them: the map may reach far. Empty without a path.
Eigen::AlignedBox2d viewOf(const std::vector<PlotLayer>& layers);

/// Commands that show a view.
std::string rangesOf(const Eigen::AlignedBox2d& view);

/// Of a picture of this width with a legend beside the view, px.
int heightOf(const Eigen::AlignedBox2d& view, int width);

/// The data blocks $PREFIX0, $PREFIX1, ... of the layers.
void writeData(std::ostream& script, const std::string& prefix, const std::vector<PlotLayer>& layers);

/// What follows `plot`.
std::string plotOf(const std::string& prefix, const std::vector<PlotLayer>& layers);

/// Draws the layers seen from above: `stem`.svg and `stem`.png, each written aside and renamed. Throws
/// std::runtime_error naming the file when gnuplot is missing or fails.
void drawLayers(const std::filesystem::path& stem, const std::vector<PlotLayer>& layers);

}  // namespace vmcl

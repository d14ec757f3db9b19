// SPDX-License-Identifier: BSD-3-Clause
#include "gnuplot.h"
#include "map_layers.h"
#include "vmcl/evaluation/localization_picture.h"
#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

std::vector<PlotLayer> layersOf(const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps) {
  std::vector<PlotLayer> layers = mapLayers(maps);
  if (run.ground_truth) layers.push_back(groundTruthLayer(*run.ground_truth));
  const std::vector<TimedEstimate> estimates = estimatesOf(run.frames);
  layers.push_back(pathLayer("localized", "with lines lw 2 lc rgb '#1f4fd8'", estimates));
  if (!estimates.empty())
    layers.push_back(pathLayer("end", "with points pt 7 ps 1 lc rgb '#d62728'", {estimates.back()}));
  std::erase_if(layers, [](const PlotLayer& layer) { return layer.empty(); });
  return layers;
}

void writeScript(std::ostream& script, const std::vector<PlotLayer>& layers, const std::filesystem::path& svg,
                 const std::filesystem::path& png) {
  const Eigen::AlignedBox2d view = viewOf(layers);
  constexpr int width = 900;
  const std::string size = std::to_string(width) + ',' + std::to_string(heightOf(view, width));
  writeData(script, "layer", layers);
  script << rangesOf(view)
         << "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset grid lc rgb '#dddddd'\nset key outside\n"
         << "set terminal svg size " << size << " background rgb 'white'\nset output " << quoted(svg) << "\nplot "
         << plotOf("layer", layers) << "\nset terminal pngcairo size " << size << "\nset output " << quoted(png)
         << "\nreplot\n";
}

}  // namespace

void drawPath(const std::filesystem::path& stem, const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps) {
  const std::vector<PlotLayer> layers = layersOf(run, maps);
  if (layers.empty()) return;
  AtomicFile script(stem.string() + ".gnuplot"), svg(stem.string() + ".svg"), png(stem.string() + ".png");
  writeScript(script.stream(), layers, svg.temporaryPath(), png.temporaryPath());
  script.stream().flush();
  runGnuplot(script.temporaryPath(), stem.string() + ".svg");
  svg.commit();
  png.commit();
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "map_layers.h"
#include "vmcl/evaluation/localization_picture.h"

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

}  // namespace

void drawPath(const std::filesystem::path& stem, const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps) {
  const std::vector<PlotLayer> layers = layersOf(run, maps);
  if (layers.empty()) return;
  drawLayers(stem, layers);
}

}  // namespace vmcl

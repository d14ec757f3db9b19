// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/map_picture.h"

#include <mrpt/opengl/COpenGLScene.h>

#include <iterator>
#include <map>
#include <stdexcept>

#include "map_layers.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {
namespace {

/// Where the robot went on each session, keyframe by keyframe.
std::vector<PlotLayer> sessionLayers(const KeyframeMap& map) {
  std::map<int, PlotLayer> layers;
  for (const Keyframe& keyframe : map.keyframes) {
    const int session = keyframe.session;
    const auto [layer, is_new] = layers.try_emplace(session);
    if (is_new) {
      layer->second.name = "session " + std::to_string(session);
      layer->second.style = "with lines lw 1.5 lc " + std::to_string(session + 1);
    }
    layer->second.addToPath(keyframe.map_from_robot.translation().x(), keyframe.map_from_robot.translation().y());
  }
  std::vector<PlotLayer> sorted;
  for (auto& [session, layer] : layers) sorted.push_back(std::move(layer));
  return sorted;
}

void writeScene(const std::filesystem::path& file, const mrpt::maps::CMultiMetricMap& maps) {
  mrpt::opengl::COpenGLScene scene;
  scene.insert(maps.getVisualization());
  AtomicFile out(file);
  if (!scene.saveToFile(out.temporaryPath().string())) throw std::runtime_error(file.string() + ": cannot be written");
  out.commit();
}

}  // namespace

void drawMap(const std::filesystem::path& stem, std::shared_ptr<const KeyframeMap> map) {
  mrpt::maps::CMultiMetricMap maps;
  maps.maps.push_back(std::make_shared<VisualKeyframeMap>(VisualMapOptions(), map));
  writeScene(stem.string() + ".3Dscene", maps);

  std::vector<PlotLayer> layers = mapLayers(maps), sessions = sessionLayers(*map);
  std::move(sessions.begin(), sessions.end(), std::back_inserter(layers));
  drawLayers(stem, layers);
}

}  // namespace vmcl

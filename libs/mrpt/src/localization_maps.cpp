// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/system/filesystem.h>

#include <stdexcept>

#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/localization_config.h"
#include "vmcl/mrpt/object_file.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {
namespace {

using mrpt::maps::CMultiMetricMap;

void fillFromFile(CMultiMetricMap& maps, const std::filesystem::path& file) {
  const std::string kind = mrpt::system::extractFileExtension(file.string(), /*ignore_gz=*/true);
  if (kind == "simplemap") {
    mrpt::maps::CSimpleMap simple_map;
    readObject(file, simple_map);
    if (simple_map.size() == 0) throw std::runtime_error(file.string() + ": is an empty simplemap");
    maps.loadFromProbabilisticPosesAndObservations(simple_map);
  } else if (kind == "gridmap") {
    const auto grid = maps.mapByClass<mrpt::maps::COccupancyGridMap2D>();
    if (!grid) throw std::runtime_error(file.string() + ": needs [MetricMap] occupancyGrid_count = 1");
    readObject(file, *grid);
  } else {
    throw std::runtime_error(file.string() + ": is neither a .simplemap nor a .gridmap nor a .vmap");
  }
}

/// Errors name the map's file, or the one that should have filled it.
void prepareVisualMaps(const CMultiMetricMap& maps, const std::filesystem::path& filled_by) {
  for (const auto& map : maps.maps) {
    const auto* visual = dynamic_cast<const VisualKeyframeMap*>(map.get());
    if (visual == nullptr) continue;
    const std::string file =
        visual->visualOptions().map_file.empty() ? filled_by.string() : visual->visualOptions().map_file;
    try {
      if (!visual->prepare())
        throw std::runtime_error("the visual map is empty: give --map FILE.vmap, map_file or a simplemap with images");
    } catch (const std::exception& error) {
      throw std::runtime_error(file + ": " + errorMessage(error));
    }
  }
}

}  // namespace

CMultiMetricMap::Ptr loadMaps(const LocalizationConfig& config) {
  auto maps = CMultiMetricMap::Create();
  try {
    maps->setListOfMaps(config.maps);
  } catch (const std::exception& error) {
    throw std::runtime_error(config.ini_file.string() + ": " + errorMessage(error));
  }
  if (!config.map_file.empty()) {
    fillFromFile(*maps, config.map_file);
  } else if (!config.odometry_only && maps->mapByClass<mrpt::maps::COccupancyGridMap2D>()) {
    throw std::runtime_error(config.ini_file.string() +
                             ": [MetricMap] occupancyGrid_count = 1, but no .simplemap or .gridmap is given");
  }
  prepareVisualMaps(*maps, config.map_file.empty() ? config.ini_file : config.map_file);
  return maps;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "map_region.h"

#include <limits>
#include <stdexcept>

#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {

using mrpt::maps::CMultiMetricMap;
using mrpt::maps::COccupancyGridMap2D;

PoseRegion regionOf(const CMultiMetricMap& maps, const std::optional<PoseBox>& extent) {
  if (const auto grid = maps.mapByClass<COccupancyGridMap2D>(); grid && !grid->isEmpty())
    return {{grid->getXMin(), grid->getXMax(), grid->getYMin(), grid->getYMax()}, *grid};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PoseBox box{infinity, -infinity, infinity, -infinity};
  if (extent) box = {extent->min_x, extent->max_x, extent->min_y, extent->max_y};
  for (const auto& map : maps.maps)
    if (const auto* relocalizing = dynamic_cast<const RelocalizingMap*>(map.get())) relocalizing->extend(box);
  return PoseRegion(box.min_x <= box.max_x ? box : PoseBox{});
}

PoseRegion startRegion(const LocalizationConfig& config, const CMultiMetricMap& maps) {
  if (!config.start_in_free_space) return PoseRegion(config.start);
  const auto grid = maps.mapByClass<COccupancyGridMap2D>();
  if (!grid) throw std::invalid_argument("init_PDF_mode = 0 needs a grid map ([MetricMap] occupancyGrid_count = 1)");
  return {config.start, *grid};
}

}  // namespace vmcl

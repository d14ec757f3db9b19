// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>

#include <optional>

#include "vmcl/mrpt/localization_config.h"
#include "vmcl/mrpt/pose_region.h"

namespace vmcl {

/// Where a robot in these maps may be: the free space of the grid map, or else the extent together with the visual
/// maps; at any heading. Of no volume when neither tells. Throws std::invalid_argument when a grid map has no free
/// cell.
PoseRegion regionOf(const mrpt::maps::CMultiMetricMap& maps, const std::optional<PoseBox>& extent);

/// Where the configuration has the robot start. Throws std::invalid_argument when it asks for a grid map's free space
/// and there is none.
PoseRegion startRegion(const LocalizationConfig& config, const mrpt::maps::CMultiMetricMap& maps);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>

#include <span>

#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/mrpt/health.h"
#include "vmcl/mrpt/pose_region.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {

/// Whether an image confirms a pose: by its likelihood there, against chance and against the poses that the image
/// itself was found to have. All log likelihoods are those that weigh particles, with matches that are not independent
/// counted as parts.
/// - agrees: e^2 times likelier than chance, and not e^3 times less likely than at the best mode
/// - contradicts: at a mode elsewhere (over 0.5 m or 15 deg) e^3 times likelier, and there e^2 times likelier than
/// chance
Verdict judgeImage(const RelocalizingMap& map, const mrpt::obs::CObservation& observation,
                   std::span<const PoseMode> modes, const PlanarPose& robot_in_map);

/// Whether any other observation, such as a laser scan, confirms a pose, by its rank among 100 poses drawn anywhere in
/// the map, most of which are wrong.
/// - agrees: at most one of them explains the observation better
/// - contradicts: one in ten does
/// - untestable: all explain it alike, or there is no region to draw from
Verdict judgeByRank(const mrpt::maps::CMetricMap& map, const mrpt::obs::CObservation& observation,
                    const PoseRegion& anywhere, const PlanarPose& robot_in_map, Random& random);

}  // namespace vmcl

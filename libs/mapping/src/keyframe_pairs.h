// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Angle (rad) by which a point straight ahead at a typical distance is seen differently from the two views: the turn
/// of the optical axis plus the parallax.
double viewDifference(const Rigid3& map_from_first, const Rigid3& map_from_second);

/// Pairs (first < second) of views likely to share scene: each view with those others that differ least from it by
/// viewDifference(), as far as their fields of view overlap. This finds neighbours in time and closed loops alike.
std::vector<std::pair<int, int>> overlappingPairs(const std::vector<ReferenceCamera>& views, int neighbours);

}  // namespace vmcl

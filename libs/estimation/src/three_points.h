// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// P3P: poses of a robot anywhere that meet three matches with depth seen by one camera, at most four. The distances
/// d_i along the rays obey three equations d^T Q d = |X_i - X_j|^2 (law of cosines), two combinations of which are
/// conics without a constant; a degenerate conic of their pencil is two lines, which meet them in the solutions
/// (Finsterwalder; Persson and Nordberg, ECCV 2018, choose it by the same cubic). None for points on a line.
std::vector<Rigid3> solveThreePoints(const std::array<RayToPoint, 3>& matches);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "vmcl/estimation/one_point_one_depth.h"
#include "vmcl/estimation/rays.h"

namespace vmcl {

/// The planar poses from the bearings alone of three matches with depth, whatever the heights: for points level with
/// the camera, whose height does not tell their distance. With t' = -R^T t each match is linear,
///
///     f_h x (R^T X_h + t' - o_h) = 0;
///
/// the combination without t' gives the heading. None for points and robot on a circle, or behind the cameras.
PlanarRoots solveThreeBearings(const std::array<RayToPoint, 3>& matches);

}  // namespace vmcl

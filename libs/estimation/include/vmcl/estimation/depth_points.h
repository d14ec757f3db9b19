// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"

namespace vmcl {

/// 2DP, and the same for N >= 2 matches with depth (MC2DP for rigs): the planar pose map_from_robot that minimizes the
/// angular errors. With Y = R^T (X - t) the point in the robot frame, each match gives two equations linear in
/// (cos phi, sin phi, -R^T t),
///
///     bearing  f_h x (Y_h - o_h) = 0,      height  f_v |Y_h - o_h| = |f_h| (X_v - o_v),
///
/// each divided by the range of the point as its height tells it. The translation is eliminated and the quadratic that
/// is left is minimized on the unit circle, exactly (secular equation). The height equation, unlike the paper's
/// division by f_v, does no harm for points near the horizon. Nothing when the points coincide or lie behind the
/// cameras.
std::optional<PlanarTransform> solveDepthPoints(std::span<const RayToPoint> matches);

}  // namespace vmcl

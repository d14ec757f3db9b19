// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/planar_transform.h"

namespace vmcl {

/// The planar poses map_from_robot at which three matches without depth meet: with no depth at all the scale comes from
/// rays of two or more references (or cameras of a rig). With R f the query ray turned into the map, each match is
///
///     g . (R f x (R o + t - c)) = 0,
///
/// linear in the ground position t; the three agree where the determinant of their coefficients, a trigonometric
/// polynomial of degree 3 in the heading, vanishes: at most six poses. None where all rays come from one place.
std::vector<PlanarTransform> solveThreeRays(const std::array<RayToRay, 3>& matches);

}  // namespace vmcl

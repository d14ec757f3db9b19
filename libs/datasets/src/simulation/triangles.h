// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "scene.h"

namespace vmcl {

/// A piece of an object's skin, in the map.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t object = 0;
};

/// All that can be touched and scanned: faces and models, without the backdrop.
std::vector<Triangle> trianglesOf(const Scene& scene);

void appendTriangles(std::vector<Triangle>& triangles, const std::vector<Face>& faces);

}  // namespace vmcl

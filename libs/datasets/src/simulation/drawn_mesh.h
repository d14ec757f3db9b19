// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light.h"
#include "model_mesh.h"
#include "scene.h"
#include "texture_atlas.h"

namespace vmcl {

struct DrawnVertex {
  Eigen::Vector3f point;   ///< in the map
  Eigen::Vector3f normal;  ///< unit, outward
  Eigen::Vector2f uv;      ///< of the image, v downwards
  float light = 1;         ///< how brightly the image is shown
};

/// Three vertices a triangle.
using DrawnMesh = std::vector<DrawnVertex>;

/// Cuts faces into cells of at most `cell` metres, fine enough to carry the light.
DrawnMesh drawFaces(const std::vector<Face>& faces, const std::vector<Surface>& surfaces, const TextureAtlas& atlas,
                    double cell);

/// Cuts the triangles of a part likewise.
DrawnMesh drawModelPart(const Model& model, const ModelPart& part, double cell);

/// Lights all vertices, on all cores; the result does not depend on their number.
void illuminate(DrawnMesh& mesh, const LightTracer& light);

/// Lights what moves, without shadows on itself: by the light from six sides at one point of each half metre ("ambient
/// cubes", Mitchell et al. 2006).
void illuminateCoarsely(DrawnMesh& mesh, const LightTracer& light);

}  // namespace vmcl

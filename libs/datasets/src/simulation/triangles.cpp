// SPDX-License-Identifier: BSD-3-Clause
#include "triangles.h"

#include "model_mesh.h"

namespace vmcl {

void appendTriangles(std::vector<Triangle>& triangles, const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    const auto& c = face.corners;
    triangles.push_back({{c[0], c[1], c[2]}, face.object});
    triangles.push_back({{c[0], c[2], c[3]}, face.object});
  }
}

std::vector<Triangle> trianglesOf(const Scene& scene) {
  std::vector<Triangle> triangles;
  appendTriangles(triangles, scene.faces);
  for (const Model& model : scene.models)
    for (const ModelPart& part : model.mesh->parts)
      for (std::size_t i = 0; i + 2 < part.vertices.size(); i += 3) {
        Triangle triangle;
        triangle.object = model.object;
        for (std::size_t corner = 0; corner < 3; ++corner)
          triangle.corners[corner] =
              model.map_from_model * (model.scale * part.vertices[i + corner].point.cast<double>());
        triangles.push_back(triangle);
      }
  return triangles;
}

}  // namespace vmcl

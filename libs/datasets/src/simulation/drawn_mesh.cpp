// SPDX-License-Identifier: BSD-3-Clause
#include "drawn_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <thread>

namespace vmcl {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;

Vector3d between(const std::array<Vector3d, 4>& corners, double x, double y) {
  return (1 - y) * ((1 - x) * corners[0] + x * corners[1]) + y * ((1 - x) * corners[3] + x * corners[2]);
}

DrawnVertex vertexOf(const Face& face, const Surface& surface, const TextureAtlas& atlas, double x, double y) {
  const cv::Rect& place = atlas.places[face.surface];
  const double column = place.x + place.width * (face.offset.x() + x * face.width) / surface.width;
  const double row = place.y + place.height * (1 - (face.offset.y() + y * face.height) / surface.height);
  DrawnVertex vertex;
  vertex.point = between(face.corners, x, y).cast<float>();
  vertex.normal = between(face.normals, x, y).normalized().cast<float>();
  vertex.uv = {static_cast<float>(column / atlas.image.cols), static_cast<float>(row / atlas.image.rows)};
  return vertex;
}

DrawnVertex middle(const DrawnVertex& a, const DrawnVertex& b) {
  return {(a.point + b.point) / 2, (a.normal + b.normal).normalized(), (a.uv + b.uv) / 2, 1};
}

/// Halves the longest edge while it is too long; neighbours halve a common edge at the same point.
void cut(DrawnMesh& mesh, const std::array<DrawnVertex, 3>& corners, float longest) {
  int edge = 0;
  float length = 0;
  for (int i = 0; i < 3; ++i) {
    const float candidate = (corners[(i + 1) % 3].point - corners[i].point).norm();
    if (candidate <= length) continue;
    length = candidate;
    edge = i;
  }
  if (length <= longest) {
    mesh.insert(mesh.end(), corners.begin(), corners.end());
    return;
  }
  const DrawnVertex &a = corners[edge], &b = corners[(edge + 1) % 3], &c = corners[(edge + 2) % 3];
  const DrawnVertex m = middle(a, b);
  cut(mesh, {a, m, c}, longest);
  cut(mesh, {m, b, c}, longest);
}

}  // namespace

DrawnMesh drawFaces(const std::vector<Face>& faces, const std::vector<Surface>& surfaces, const TextureAtlas& atlas,
                    double cell) {
  DrawnMesh mesh;
  for (const Face& face : faces) {
    const Surface& surface = surfaces[face.surface];
    const double own_cell = surface.glows ? 1e9 : cell;
    const double wide = (face.corners[1] - face.corners[0]).norm(), high = (face.corners[3] - face.corners[0]).norm();
    const int columns = std::max(1, static_cast<int>(std::ceil(wide / own_cell)));
    const int rows = std::max(1, static_cast<int>(std::ceil(high / own_cell)));
    const auto corner = [&](int column, int row) {
      return vertexOf(face, surface, atlas, static_cast<double>(column) / columns, static_cast<double>(row) / rows);
    };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const DrawnVertex a = corner(column, row), b = corner(column + 1, row), c = corner(column + 1, row + 1),
                          d = corner(column, row + 1);
        mesh.insert(mesh.end(), {a, b, c, a, c, d});
      }
  }
  return mesh;
}

DrawnMesh drawModelPart(const Model& model, const ModelPart& part, double cell) {
  DrawnMesh mesh;
  for (std::size_t i = 0; i + 2 < part.vertices.size(); i += 3) {
    std::array<DrawnVertex, 3> corners;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const ModelPart::Vertex& vertex = part.vertices[i + corner];
      const Vector3d normal = model.map_from_model.linear() * vertex.normal.cast<double>();
      corners[corner].point = (model.map_from_model * (model.scale * vertex.point.cast<double>())).cast<float>();
      corners[corner].normal = (normal.norm() > 1e-9 ? normal.normalized() : Vector3d::UnitZ()).cast<float>();
      corners[corner].uv = vertex.uv;
    }
    cut(mesh, corners, static_cast<float>(cell));
  }
  return mesh;
}

void illuminate(DrawnMesh& mesh, const LightTracer& light) {
  using Key = std::array<float, 6>;
  const auto keyOf = [](const DrawnVertex& v) {
    return Key{v.point.x(), v.point.y(), v.point.z(), v.normal.x(), v.normal.y(), v.normal.z()};
  };
  std::map<Key, std::vector<std::size_t>> places;  // most vertices are shared by several triangles
  for (std::size_t i = 0; i < mesh.size(); ++i) places[keyOf(mesh[i])].push_back(i);
  std::vector<const std::vector<std::size_t>*> shared;
  for (const auto& [key, vertices] : places) shared.push_back(&vertices);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < shared.size();) {
      const DrawnVertex& first = mesh[shared[i]->front()];
      const float value = light.at(first.point.cast<double>(), first.normal.cast<double>());
      for (const std::size_t vertex : *shared[i]) mesh[vertex].light = value;
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) workers.emplace_back(work);
  work();
}

void illuminateCoarsely(DrawnMesh& mesh, const LightTracer& light) {
  constexpr float cell = 0.5f;  // m
  std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Eigen::Vector3i at = (mesh[i].point / cell).array().floor().cast<int>();
    cells[{at.x(), at.y(), at.z()}].push_back(i);
  }
  for (const auto& [at, vertices] : cells) {
    Vector3d center = Vector3d::Zero();
    for (const std::size_t i : vertices) center += mesh[i].point.cast<double>() / static_cast<double>(vertices.size());
    std::array<float, 6> sides{};
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {0, 1}) sides[2 * axis + sign] = light.at(center, (2 * sign - 1) * Vector3d::Unit(axis));
    for (const std::size_t i : vertices) {
      mesh[i].light = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float cosine = mesh[i].normal[axis];
        mesh[i].light += cosine * cosine * sides[2 * axis + (cosine > 0)];
      }
    }
  }
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace vmcl {
namespace {

using Eigen::Vector3f;

constexpr int leaf_size = 4;

/// Whether a ray enters a box before `most`.
bool enters(const Vector3f& low, const Vector3f& high, const Vector3f& origin, const Vector3f& inverse, float most) {
  const Eigen::Array3f a = (low - origin).array() * inverse.array(), b = (high - origin).array() * inverse.array();
  return std::max(a.min(b).maxCoeff(), 0.0f) <= std::min(a.max(b).minCoeff(), most);
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    const auto& c = triangle.corners;
    triangles_.push_back({c[0].cast<float>(), (c[1] - c[0]).cast<float>(), (c[2] - c[0]).cast<float>()});
  }
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

void TriangleTree::build(int first, int count) {
  Node node;
  node.low = node.high = triangles_[first].corner;
  for (int i = first; i < first + count; ++i) {
    const Flat& t = triangles_[i];
    for (const Vector3f& p : {t.corner, Vector3f(t.corner + t.first_edge), Vector3f(t.corner + t.second_edge)}) {
      node.low = node.low.cwiseMin(p);
      node.high = node.high.cwiseMax(p);
    }
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back(node);
  if (count <= leaf_size) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return;
  }
  int axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(triangles_.begin() + first, triangles_.begin() + first + half, triangles_.begin() + first + count,
                   [axis](const Flat& a, const Flat& b) { return a.center()[axis] < b.center()[axis]; });
  build(first, half);
  nodes_[index].first = static_cast<int>(nodes_.size());
  build(first + half, count - half);
}

std::optional<float> TriangleTree::firstHit(const Vector3f& origin, const Vector3f& direction, float most) const {
  if (nodes_.empty()) return std::nullopt;
  const Vector3f inverse = direction.cwiseInverse();
  std::array<int, 64> waiting{};
  int depth = 0;
  float nearest = most;
  waiting[depth++] = 0;
  while (depth > 0) {
    const int index = waiting[--depth];
    const Node& node = nodes_[index];
    if (!enters(node.low, node.high, origin, inverse, nearest)) continue;
    if (node.count == 0) {
      waiting[depth++] = node.first;
      waiting[depth++] = index + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {  // Moeller and Trumbore 1997
      const Flat& t = triangles_[i];
      const Vector3f p = direction.cross(t.second_edge);
      const float determinant = t.first_edge.dot(p);
      if (std::abs(determinant) < 1e-12f) continue;
      const Vector3f s = origin - t.corner;
      const float u = s.dot(p) / determinant;
      if (u < 0 || u > 1) continue;
      const Vector3f q = s.cross(t.first_edge);
      const float v = direction.dot(q) / determinant;
      if (v < 0 || u + v > 1) continue;
      const float distance = t.second_edge.dot(q) / determinant;
      if (distance > 0) nearest = std::min(nearest, distance);
    }
  }
  if (nearest < most) return nearest;
  return std::nullopt;
}

}  // namespace vmcl

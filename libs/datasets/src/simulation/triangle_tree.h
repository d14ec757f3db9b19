// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "triangles.h"

namespace vmcl {

/// Finds what a ray hits first, by a hierarchy of bounding boxes (Kay and Kajiya 1986), split at the median.
class TriangleTree {
 public:
  explicit TriangleTree(const std::vector<Triangle>& triangles);

  /// Distance to the first triangle along a unit direction, if it is below `most` (m).
  std::optional<float> firstHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float most) const;

 private:
  struct Flat {
    Eigen::Vector3f corner, first_edge, second_edge;
    Eigen::Vector3f center() const { return corner + (first_edge + second_edge) / 3; }
  };
  /// A leaf if `count` is not zero; otherwise its children are the next node and the node `first`.
  struct Node {
    Eigen::Vector3f low, high;
    int first = 0;
    int count = 0;
  };

  void build(int first, int count);

  std::vector<Flat> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace vmcl

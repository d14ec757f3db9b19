// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vmcl/geometry/camera.h"

namespace vmcl {

/// What a keyframe keeps to be matched anywhere, not at its features alone. Pixels are those of the image as taken,
/// distorted.
struct DenseView {
  static constexpr int depth_step = 4;  ///< pixels

  std::vector<uint8_t> image;   ///< grey, JPEG; empty: the map is not dense
  std::vector<uint16_t> depth;  ///< along the optical axis, mm, at every depth_step-th pixel of every depth_step-th
                                ///< row, 0 where unknown; empty: not measured

  /// Numbers of depths along a row and a column.
  static int depthColumns(const PinholeCamera& camera) { return (camera.width + depth_step - 1) / depth_step; }
  static int depthRows(const PinholeCamera& camera) { return (camera.height + depth_step - 1) / depth_step; }

  /// Depth (m) at a pixel, interpolated as on a plane; nothing where a neighbour is unknown or at an edge.
  std::optional<double> depthAt(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
};

}  // namespace vmcl

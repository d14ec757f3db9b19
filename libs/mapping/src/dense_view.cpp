// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/dense_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vmcl {

std::optional<double> DenseView::depthAt(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const {
  constexpr double largest_step = 1.1;  // ratio of neighbours on one surface
  if (depth.empty() || !camera.contains(pixel)) return std::nullopt;
  const int columns = depthColumns(camera), rows = depthRows(camera);
  const double u = std::clamp(pixel.x() / depth_step, 0.0, columns - 1.0);
  const double v = std::clamp(pixel.y() / depth_step, 0.0, rows - 1.0);
  const int left = std::min(static_cast<int>(u), std::max(columns - 2, 0));
  const int top = std::min(static_cast<int>(v), std::max(rows - 2, 0));
  std::array<uint16_t, 4> corners{};
  double inverse = 0;
  for (int i = 0; i < 4; ++i) {
    const int column = std::min(left + i % 2, columns - 1), row = std::min(top + i / 2, rows - 1);
    corners[static_cast<std::size_t>(i)] = depth[static_cast<std::size_t>(row * columns + column)];
    const double weight = (i % 2 ? u - left : 1 - (u - left)) * (i / 2 ? v - top : 1 - (v - top));
    inverse += weight / corners[static_cast<std::size_t>(i)];
  }
  const auto [nearest, farthest] = std::ranges::minmax(corners);
  if (nearest == 0 || farthest > largest_step * nearest) return std::nullopt;
  return 1e-3 / inverse;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/depth_image.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vmcl {

float depthAt(const DepthImage& image, const Eigen::Vector2d& pixel) {
  constexpr int reach = 2;  // pixels to each side
  constexpr float largest_step = 0.1f;
  if (!(pixel.array().abs() < 1e6).all()) return 0;
  const int column = static_cast<int>(std::lround(pixel.x())), row = static_cast<int>(std::lround(pixel.y()));
  std::array<float, (2 * reach + 1) * (2 * reach + 1)> known{};
  std::size_t count = 0;
  for (int v = std::max(0, row - reach); v <= std::min(image.height - 1, row + reach); ++v)
    for (int u = std::max(0, column - reach); u <= std::min(image.width - 1, column + reach); ++u)
      if (const float depth = image.depths[static_cast<std::size_t>(v * image.width + u)]; depth > 0)
        known[count++] = depth;
  if (count <= known.size() / 2) return 0;
  std::sort(known.begin(), known.begin() + count);
  const float median = known[count / 2];
  return known[count - 1] - known[0] > largest_step * median ? 0 : median;
}

}  // namespace vmcl

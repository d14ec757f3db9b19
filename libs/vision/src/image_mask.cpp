// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/image_mask.h"

#include <stdexcept>
#include <string>

namespace vmcl {

void ImageMask::check(int width, int height) const {
  if (rows_from_top < 0 || rows_from_top >= height)
    throw std::invalid_argument("mask_rows_from_top is " + std::to_string(rows_from_top) + " of " +
                                std::to_string(height) + " image rows");
  if (white.empty()) return;
  if (white.width != width || white.height != height || white.channels != 1 ||
      white.row_bytes < static_cast<std::size_t>(width))
    throw std::invalid_argument("the mask is " + std::to_string(white.width) + " x " + std::to_string(white.height) +
                                " pixels of " + std::to_string(white.channels) + " channels, its image " +
                                std::to_string(width) + " x " + std::to_string(height));
}

bool ImageMask::hides(const Eigen::Vector2f& pixel) const {
  const Eigen::Vector2i at = pixel.array().round().cast<int>();
  if (at.y() >= 0 && at.y() < rows_from_top) return true;
  return !white.empty() && at.x() >= 0 && at.x() < white.width && at.y() >= 0 && at.y() < white.height &&
         white.pixels[static_cast<std::size_t>(at.y()) * white.row_bytes + static_cast<std::size_t>(at.x())] >= 128;
}

}  // namespace vmcl

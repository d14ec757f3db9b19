// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vmcl/vision/image.h"

namespace vmcl {

/// Where an image shows the robot itself. The pixels are somebody else's.
struct ImageMask {
  int rows_from_top = 0;  ///< everywhere in these, and
  ImageView white{};      ///< where this grey image of the same size is 128 or more; empty: nowhere else

  /// Throws std::invalid_argument unless it fits an image of this size and its rows leave something of it.
  void check(int width, int height) const;

  /// Whether the robot is what the pixel shows; one outside the image shows nothing.
  bool hides(const Eigen::Vector2f& pixel) const;
};

}  // namespace vmcl

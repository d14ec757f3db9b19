// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "vmcl/vision/image_mask.h"

namespace vmcl {

/// Where the query image shows what the reference image shows at one of the given points.
struct DenseMatch {
  int point = 0;  ///< index
  Eigen::Vector2f query_pixel = Eigen::Vector2f::Zero();
};

/// Finds points of reference images in one query image wherever they are, not at features alone. Pixels are those of
/// the images as taken, distorted. Thread safe.
class DenseMatcher {
 public:
  virtual ~DenseMatcher() = default;

  /// Of the points found; most of those named are right. Throws std::invalid_argument for an empty image.
  virtual std::vector<DenseMatch> match(const ImageView& reference, std::span<const Eigen::Vector2f> points) const = 0;
};

inline constexpr int dense_grid_step = 8;  ///< pixels between the points of denseGrid()

/// Points all over an image of this size but for what the mask hides. Throws std::invalid_argument when that does not
/// fit.
std::vector<Eigen::Vector2f> denseGrid(int width, int height, const ImageMask& mask);

/// The classical way, without weights: histograms of gradients at each point (as DAISY, Tola et al. 2010, upright) and
/// on a grid of the query image; of nearest ones, mutual but for the grid's step, those are kept
/// that move as their neighbours do, and refined to a part of a pixel by Lucas and Kanade's method there and back on
/// images of normalized contrast. No match lies in what the mask hides, whose pixels the matcher keeps looking at.
std::unique_ptr<DenseMatcher> gridMatcher(const ImageView& query, const ImageMask& mask);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "texture_atlas.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace vmcl {

TextureAtlas packAtlas(const std::vector<cv::Mat>& images, int max_side_px) {
  constexpr int border = 2;
  std::vector<std::size_t> order(images.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return images[a].rows > images[b].rows; });
  int width = 4096;
  for (const cv::Mat& image : images) width = std::max(width, image.cols + 2 * border);
  TextureAtlas atlas;
  atlas.places.resize(images.size());
  int x = 0, shelf_bottom = 0, shelf_top = 0;
  for (const std::size_t i : order) {
    if (images[i].empty()) continue;
    const cv::Size size(images[i].cols + 2 * border, images[i].rows + 2 * border);
    if (x + size.width > width) {
      x = 0;
      shelf_top = shelf_bottom;
    }
    shelf_bottom = std::max(shelf_bottom, shelf_top + size.height);
    atlas.places[i] = {x + border, shelf_top + border, images[i].cols, images[i].rows};
    x += size.width;
  }
  if (width > max_side_px || shelf_bottom > max_side_px)
    throw std::runtime_error("the surfaces of the scene are too large to be drawn");
  atlas.image = cv::Mat(shelf_bottom, width, CV_8UC3, cv::Scalar::all(0));
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].empty()) continue;
    const cv::Rect& place = atlas.places[i];
    const cv::Rect outer(place.x - border, place.y - border, place.width + 2 * border, place.height + 2 * border);
    cv::copyMakeBorder(images[i], atlas.image(outer), border, border, border, border, cv::BORDER_REPLICATE);
  }
  return atlas;
}

}  // namespace vmcl

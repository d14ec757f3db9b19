// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/dense_matching.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_texture.h"

namespace vmcl {
namespace {

/// The image enlarged by a tenth about its corner, moved, and in dimmer light.
Image changed(const Image& image, const Eigen::Vector2d& shift) {
  Image result = image;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const Eigen::Vector2d from = (Eigen::Vector2d(u, v) - shift) / 1.1;
      const int x = std::clamp(static_cast<int>(std::floor(from.x())), 0, image.width - 2);
      const int y = std::clamp(static_cast<int>(std::floor(from.y())), 0, image.height - 2);
      const double dx = std::clamp(from.x() - x, 0.0, 1.0), dy = std::clamp(from.y() - y, 0.0, 1.0);
      const auto at = [&](int column, int row) {
        return double{static_cast<double>(image.pixels[static_cast<std::size_t>(row * image.width + column)])};
      };
      const double grey =
          (1 - dy) * ((1 - dx) * at(x, y) + dx * at(x + 1, y)) + dy * ((1 - dx) * at(x, y + 1) + dx * at(x + 1, y + 1));
      result.pixels[static_cast<std::size_t>(v * image.width + u)] = static_cast<uint8_t>(std::lround(0.6 * grey + 10));
    }
  return result;
}

TEST(GridMatcherTest, FindsPointsToAPartOfAPixel) {
  const Image reference = rectangleTexture(320, 240, 5);
  const Eigen::Vector2d shift(-23.4, 12.7);
  const Image query = changed(reference, shift);
  const std::vector<Eigen::Vector2f> points = denseGrid(320, 240, {});
  const std::vector<DenseMatch> matches = gridMatcher(query.view(), {})->match(reference.view(), points);
  ASSERT_GT(matches.size(), points.size() / 2);
  int good = 0;
  for (const DenseMatch& match : matches) {
    const Eigen::Vector2d truth = 1.1 * points[static_cast<std::size_t>(match.point)].cast<double>() + shift;
    good += (match.query_pixel.cast<double>() - truth).norm() < 1.5;
  }
  EXPECT_GT(good, 0.9 * static_cast<double>(matches.size()));
}

TEST(GridMatcherTest, FindsNextToNothingInAnotherImage) {
  const std::vector<Eigen::Vector2f> points = denseGrid(320, 240, {});
  const Image query = rectangleTexture(320, 240, 6), reference = rectangleTexture(320, 240, 7);
  EXPECT_LT(gridMatcher(query.view(), {})->match(reference.view(), points).size(), points.size() / 25);
}

TEST(GridMatcherTest, NothingMatchesABlankImage) {
  const std::vector<Eigen::Vector2f> points = denseGrid(320, 240, {});
  const Image texture = rectangleTexture(320, 240, 6), blank = rectangleTexture(320, 240, 1, 0);
  EXPECT_TRUE(gridMatcher(blank.view(), {})->match(texture.view(), points).empty());
  EXPECT_TRUE(gridMatcher(texture.view(), {})->match(blank.view(), points).empty());
  EXPECT_TRUE(gridMatcher(texture.view(), {})->match(texture.view(), {}).empty());
}

TEST(GridMatcherTest, NothingMatchesWhatTheMaskHides) {
  const Image texture = rectangleTexture(320, 240, 6);
  Image white{320, 240, std::vector<uint8_t>(320 * 240)};
  for (std::size_t i = 0; i < white.pixels.size(); ++i) white.pixels[i] = i % 320 < 160 ? 128 : 127;
  const ImageMask mask{80, white.view()};
  const std::vector<Eigen::Vector2f> all = denseGrid(320, 240, {}), visible = denseGrid(320, 240, mask);
  const auto isVisible = [](const Eigen::Vector2f& pixel) { return pixel.x() > 159.5f && pixel.y() > 79.5f; };
  EXPECT_EQ(std::ranges::count_if(all, isVisible), 19 * 19);
  EXPECT_EQ(visible.size(), 19 * 18);
  EXPECT_TRUE(std::ranges::all_of(visible, isVisible));
  const std::vector<DenseMatch> matches = gridMatcher(texture.view(), mask)->match(texture.view(), all);
  EXPECT_GT(matches.size(), visible.size() / 2);
  for (const DenseMatch& match : matches) EXPECT_TRUE(isVisible(match.query_pixel)) << match.query_pixel.transpose();
  EXPECT_THROW(gridMatcher(texture.view(), {240}), std::invalid_argument);
  EXPECT_THROW(denseGrid(160, 240, mask), std::invalid_argument);
}

TEST(GridMatcherTest, RefusesAnEmptyImage) {
  EXPECT_THROW(gridMatcher({}, {}), std::invalid_argument);
  const Image texture = rectangleTexture(320, 240, 6);
  EXPECT_THROW(gridMatcher(texture.view(), {})->match({}, {}), std::invalid_argument);
}

TEST(CompressedImageTest, ComesBackAlmostTheSame) {
  const Image image = rectangleTexture(320, 240, 6);
  const std::vector<uint8_t> bytes = compressImage(image.view());
  EXPECT_LT(bytes.size(), image.pixels.size() / 2);
  const Image back = decompressImage(bytes);
  ASSERT_EQ(back.width, 320);
  ASSERT_EQ(back.height, 240);
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) sum += std::abs(image.pixels[i] - back.pixels[i]);
  EXPECT_LT(sum / static_cast<double>(image.pixels.size()), 3);
  EXPECT_THROW(decompressImage({1, 2, 3}), std::runtime_error);
  EXPECT_THROW(compressImage({}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

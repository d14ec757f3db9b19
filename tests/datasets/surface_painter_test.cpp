// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/surface_painter.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "simulation/decorations.h"
#include "simulation/materials.h"
#include "simulation/texture_atlas.h"

namespace vmcl {
namespace {

const std::vector<std::string> materials{
    "plain",   "plaster",    "bricks",         "wallpaper",  "planks",       "tiles",     "carpet",  "ceiling",
    "wood",    "drawers",    "books",          "fabric",     "fridge",       "cardboard", "cloth",   "rug",
    "curtain", "leaves",     "marble",         "metal",      "screen",       "paper",     "lockers", "city",
    "garden",  "whiteboard", "ceiling_panels", "blank_wall", "office_carpet"};

Surface surface(const std::string& material, double width = 1.5, double height = 1.2) {
  return {width, height, {material, {180, 140, 100}}, {}, Eigen::Vector3d::UnitX(), 100};
}

bool equal(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

TEST(PaintSurface, sameSeedAndNumberGiveTheSameImageOthersAnother) {
  for (const std::string& material : materials) {
    ASSERT_TRUE(isMaterial(material));
    const cv::Mat image = paintSurface(surface(material), 5, 2);
    EXPECT_EQ(image.size(), cv::Size(150, 120));
    EXPECT_TRUE(equal(image, paintSurface(surface(material), 5, 2))) << material;
    EXPECT_FALSE(equal(image, paintSurface(surface(material), 5, 3))) << material;
    EXPECT_FALSE(equal(image, paintSurface(surface(material), 6, 2))) << material;
  }
  EXPECT_FALSE(isMaterial("gold"));
}

TEST(PaintSurface, everyMaterialFitsTheSmallestSurfaces) {
  for (const std::string& material : materials)
    EXPECT_NO_THROW(paintSurface(surface(material, 0.01, 0.01), 1, 1)) << material;
}

TEST(PaintSurface, noTwoDecorationsLookAlike) {
  for (const std::string kind : {"door", "painting", "poster", "window"}) {
    ASSERT_TRUE(isDecoration(kind));
    Surface wall = surface("plain", 2, 1);
    wall.decorations = {{kind, {0.5, 0.5}, {0.8, 0.8}}, {kind, {1.5, 0.5}, {0.8, 0.8}}};
    const cv::Mat image = paintSurface(wall, 1, 1);
    const cv::Mat left = image(cv::Rect(10, 10, 80, 80)), right = image(cv::Rect(110, 10, 80, 80));
    EXPECT_GT(cv::norm(left, right, cv::NORM_L1) / (80 * 80 * 3), 3) << kind;
  }
  EXPECT_FALSE(isDecoration("mirror"));
}

TEST(PaintSurface, decorationsStayInTheirPlace) {
  const Surface bare = surface("plain", 2, 1);
  Surface wall = bare;
  wall.decorations = {{"painting", {0.5, 0.7}, {0.4, 0.2}}};
  cv::Mat difference;
  cv::absdiff(paintSurface(bare, 1, 1), paintSurface(wall, 1, 1), difference);
  const cv::Rect place(30, 20, 40, 20);  // rows count from the top
  EXPECT_GT(cv::sum(difference(place))[0], 0);
  difference(place).setTo(0);
  EXPECT_EQ(cv::norm(difference), 0);
}

TEST(ShadeEvenly, lightBrightensTheSideTowardsIt) {
  const auto brightness = [](const Light& light) {
    cv::Mat image = paintSurface(surface("plain"), 1, 1);
    shadeEvenly(image, surface("plain"), light);
    return cv::mean(image)[0];
  };
  EXPECT_GT(brightness({1, 0}), brightness({1, 3}));
  EXPECT_NEAR(brightness({0.5, 0}), brightness({1, 0}) / 2, 1);
}

TEST(PackAtlas, keepsEveryImageApart) {
  Random random(2);
  std::vector<cv::Mat> images;
  for (int i = 0; i < 40; ++i)
    images.emplace_back(1 + static_cast<int>(random.below(300)), 1 + static_cast<int>(random.below(900)), CV_8UC3,
                        cv::Scalar(i + 1, 2 * i, 3 * i));
  const TextureAtlas atlas = packAtlas(images, 16384);
  ASSERT_EQ(atlas.places.size(), images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_TRUE(equal(atlas.image(atlas.places[i]), images[i]));
    for (std::size_t j = 0; j < i; ++j) EXPECT_TRUE((atlas.places[i] & atlas.places[j]).empty());
  }
}

TEST(PackAtlas, refusesWhatNoTextureHolds) {
  EXPECT_THROW(packAtlas({cv::Mat(10, 9000, CV_8UC3)}, 8192), std::runtime_error);
  EXPECT_THROW(packAtlas(std::vector<cv::Mat>(9, cv::Mat(1000, 4000, CV_8UC3)), 8192), std::runtime_error);
}

}  // namespace
}  // namespace vmcl

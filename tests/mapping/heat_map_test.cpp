// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/heat_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vmcl {
namespace {

/// A keyframe at the origin of the map, its camera's axes those of the map, which sees one landmark at a pixel.
KeyframeMap mapWithLandmark(const Eigen::Vector2f& pixel, double depth, double sigma, int observations) {
  KeyframeMap map;
  map.cameras.push_back({"camera", {{640, 480, 500, 500, 319.5, 239.5}, {}}});
  const Eigen::Vector3d point = depth * map.cameras[0].calibration.pinhole.ray(pixel.cast<double>());
  map.landmarks.push_back({point, sigma * sigma * Eigen::Matrix3d::Identity(), observations});
  Keyframe keyframe;
  keyframe.features.pixels = {pixel};
  keyframe.landmark_of_feature = {0};
  map.keyframes.push_back(keyframe);
  return map;
}

/// Blue, green and red.
Eigen::Vector3i pixelAt(const ColourImage& image, int column, int row) {
  const auto at = static_cast<std::size_t>(3 * (row * image.width + column));
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

TEST(HeatMapTest, ShowsDepthUncertaintyAndObservations) {
  const KeyframeMap map = mapWithLandmark({200, 100}, 5, 0.25, 5);
  const ColourImage image = heatMap(map, map.keyframes[0], 640, 480);
  EXPECT_EQ(pixelAt(image, 200, 100), Eigen::Vector3i(8, 16, 16));  // a quarter, a half and a half of 255 / 8
  EXPECT_EQ(pixelAt(image, 220, 100), Eigen::Vector3i(5, 10, 10));  // one deviation away: times 0.607
  EXPECT_EQ(pixelAt(image, 300, 100), Eigen::Vector3i(0, 0, 0));
}

TEST(HeatMapTest, LandmarksAddUpAndFillUp) {
  KeyframeMap map = mapWithLandmark({200, 100}, 50, 5, 100);
  EXPECT_EQ(pixelAt(heatMap(map, map.keyframes[0], 640, 480), 200, 100), Eigen::Vector3i(32, 32, 32));
  map.keyframes[0].features.pixels.assign(20, {200, 100});
  map.keyframes[0].landmark_of_feature.assign(20, 0);
  EXPECT_EQ(pixelAt(heatMap(map, map.keyframes[0], 640, 480), 200, 100), Eigen::Vector3i(255, 255, 255));
}

TEST(HeatMapTest, IsTheSamePictureInAnySize) {
  const KeyframeMap map = mapWithLandmark({201.5, 101.5}, 10, 0.5, 20);
  const ColourImage small = heatMap(map, map.keyframes[0], 160, 120);
  EXPECT_EQ(small.pixels.size(), 3u * 160 * 120);
  EXPECT_EQ(pixelAt(small, 50, 25), Eigen::Vector3i(32, 32, 32));
  EXPECT_EQ(pixelAt(small, 55, 25), Eigen::Vector3i(19, 19, 19));
}

TEST(HeatMapTest, IsBlackWithoutLandmarks) {
  KeyframeMap map = mapWithLandmark({200, 100}, 5, 0.25, 5);
  map.keyframes[0].landmark_of_feature = {-1};
  EXPECT_EQ(std::ranges::count(heatMap(map, map.keyframes[0], 64, 48).pixels, uint8_t{0}), 3 * 64 * 48);
  EXPECT_THROW(heatMap(map, map.keyframes[0], 0, 48), std::invalid_argument);
  EXPECT_THROW(heatMap(map, map.keyframes[0], 1 << 14, 48), std::invalid_argument);
}

TEST(HeatMapTest, ALandmarkBetweenTheFewPixelsOfATinyOneIsLeftOut) {
  for (float x = 0; x < 640; x += 13) {
    const KeyframeMap map = mapWithLandmark({x, 100}, 5, 0.25, 5);
    EXPECT_EQ(heatMap(map, map.keyframes[0], 1, 1).pixels.size(), 3U);
  }
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/match_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scratch_directory.h"
#include "tiny_network.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// The network is as sure as the reference is bright, and says that things are as far right and down in the query as
/// the query is bright there.
class MatchNetworkTest : public testing::Test {
 protected:
  std::string file(const TinyNetwork& network) const { return network.writtenTo(scratch_.path() / "dense.onnx"); }

  void expectRefused(const TinyNetwork& network, const char* reason) const {
    EXPECT_THAT([&] { MatchNetwork{file(network)}; },
                ThrowsMessage<std::runtime_error>(testing::AllOf(HasSubstr("dense.onnx"), HasSubstr(reason))));
  }

  /// 64 x 48 pixels, of a brightness in [0, 1] that the column tells.
  template <class Brightness>
  static Image imageOf(Brightness&& brightness) {
    Image image{64, 48, std::vector<uint8_t>(64 * 48)};
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = static_cast<uint8_t>(std::lround(255 * brightness(static_cast<int>(i % 64))));
    return image;
  }

  const ScratchDirectory scratch_;
  const Image ramp_ = imageOf([](int column) { return (column + 0.5) / 64; });
  const Image sure_on_the_right_ = imageOf([](int column) { return column < 32 ? 0.4 : 0.6; });
};

TEST_F(MatchNetworkTest, TakesWhatItIsSureOfBetweenItsCells) {
  const std::vector<Eigen::Vector2f> points{{10, 20}, {34, 20}, {40, 20}, {43.5, 30}, {51.5, 9}, {63, 47}};
  for (const auto& [height, width] : {std::pair(48, 64), {0, 0}, {96, 128}}) {
    const MatchNetwork network(file(TinyNetwork::ofTwoImages(1, height, width, height == 96 ? 16 : 8)));
    const auto matches = network.matcher(ramp_.view(), {})->match(sure_on_the_right_.view(), points);
    ASSERT_EQ(matches.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(matches[i].point, static_cast<int>(i) + 2);
      const float x = std::min(points[i + 2].x(), 59.5f);  // where the last cell has its centre
      EXPECT_NEAR(matches[i].query_pixel.x(), x, 0.25) << width;
      EXPECT_NEAR(matches[i].query_pixel.y(), 0.75f * (x + 0.5f) - 0.5f, 0.25) << width;
    }
  }
}

TEST_F(MatchNetworkTest, TakesNothingAcrossAnEdgeNorWhereTheRobotIs) {
  const Image edge = imageOf([](int column) { return column < 32 ? 0.1 : 0.8; }), sure = imageOf([](int) { return 1; });
  const std::vector<Eigen::Vector2f> points{{8, 20}, {32, 20}, {50, 20}};
  const MatchNetwork network(file(TinyNetwork::ofTwoImages(1, 48, 64, 8)));
  const auto across = network.matcher(edge.view(), {})->match(sure.view(), points);
  ASSERT_EQ(across.size(), 2u);
  EXPECT_EQ(across[1].point, 2);
  const auto masked = network.matcher(edge.view(), {.rows_from_top = 20})->match(sure.view(), points);
  ASSERT_EQ(masked.size(), 1u);
  EXPECT_EQ(masked[0].point, 2);
}

TEST_F(MatchNetworkTest, RefusesAFileThatIsNone) {
  EXPECT_THAT([&] { MatchNetwork{(scratch_.path() / "absent.onnx").string()}; },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened")));
  const TinyNetwork tiny = TinyNetwork::ofTwoImages(1, 48, 64, 8);
  const std::string cut = (scratch_.path() / "dense.onnx").string();
  for (std::size_t length = 0; length < tiny.bytes().size(); length += 7) {
    std::ofstream(cut, std::ios::binary) << tiny.bytes().substr(0, length);
    EXPECT_THAT([&] { MatchNetwork{cut}; }, ThrowsMessage<std::runtime_error>(HasSubstr("dense.onnx"))) << length;
  }
}

TEST_F(MatchNetworkTest, RefusesOtherShapes) {
  expectRefused({1, 48, 64, 8}, "1 inputs, not 2");
  expectRefused(TinyNetwork::ofTwoImages(3, 48, 64, 8), "not places (2 channels)");  // 6 and 3 channels
  expectRefused(TinyNetwork::ofTwoImages(1, 48, 64, 48), "cells");
  expectRefused(TinyNetwork::ofTwoImages(1, 48, 5000, 8), "larger than");
  const MatchNetwork network(file(TinyNetwork::ofTwoImages(1, 48, 64, 8)));
  EXPECT_THROW(network.matcher({}, {}), std::invalid_argument);
  EXPECT_THROW(network.matcher(ramp_.view(), {.rows_from_top = 48}), std::invalid_argument);
  EXPECT_THROW(network.matcher(ramp_.view(), {})->match({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

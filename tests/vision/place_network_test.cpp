// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/place_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_directory.h"
#include "synthetic_texture.h"
#include "tiny_network.h"
#include "vmcl/vision/place_recognition.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class PlaceNetworkTest : public testing::Test {
 protected:
  FeatureModel model(const TinyNetwork& network) const {
    return {network.writtenTo(scratch_.path() / "places.onnx"), 0};
  }

  void expectRefused(const TinyNetwork& network, const char* reason) const {
    FeatureModel refused = model(network);
    EXPECT_THAT([&] { PlaceNetwork{refused}; },
                ThrowsMessage<std::runtime_error>(testing::AllOf(HasSubstr("places.onnx"), HasSubstr(reason))));
  }

  const ScratchDirectory scratch_;
  const Image image_ = rectangleTexture(64, 48, 3);
};

TEST_F(PlaceNetworkTest, GivesTheOutputAsAUnitVector) {
  FeatureModel tiny = model({1, 48, 64, 16});
  const PlaceNetwork network(tiny);
  EXPECT_NE(tiny.crc32, 0u);
  ASSERT_EQ(network.size(), 12);
  Eigen::VectorXf means = Eigen::VectorXf::Zero(12);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) means[v / 16 * 4 + u / 16] += image_.pixels[static_cast<std::size_t>(v * 64 + u)];
  EXPECT_TRUE(network.describe(image_.view(), {}).isApprox(means.normalized(), 1e-5f));
  const Image black{64, 48, std::vector<uint8_t>(64 * 48)};
  EXPECT_EQ(network.describe(black.view(), {}).norm(), 0);
}

TEST_F(PlaceNetworkTest, KnowsAPlaceInAnotherSizeAndLight) {
  FeatureModel tiny = model({3, 48, 64, 8});
  const PlaceNetwork network(tiny);
  Eigen::MatrixXf places(network.size(), 5);
  for (int i = 0; i < 5; ++i)
    places.col(i) = network.describe(rectangleTexture(128, 96, static_cast<uint64_t>(i)).view(), {});
  for (int i = 0; i < 5; ++i) {
    Image darker = rectangleTexture(128, 96, static_cast<uint64_t>(i));
    for (uint8_t& pixel : darker.pixels) pixel /= 2;
    EXPECT_EQ(retrieve(places, network.describe(darker.view(), {}), 1).at(0).index, i);
  }
}

TEST_F(PlaceNetworkTest, DoesNotSeeWhatTheMaskHides) {
  FeatureModel tiny = model({1, 48, 64, 8});
  const PlaceNetwork network(tiny);
  Image white{64, 48, std::vector<uint8_t>(64 * 48)}, changed = image_;
  for (int u = 0; u < 64; ++u) {
    for (int v : {0, 1, 40}) changed.pixels[static_cast<std::size_t>(v * 64 + u)] ^= 0xff;
    white.pixels[static_cast<std::size_t>(40 * 64 + u)] = 255;
  }
  const ImageMask mask{2, white.view()};
  EXPECT_EQ(network.describe(changed.view(), mask), network.describe(image_.view(), mask));
  EXPECT_NE(network.describe(changed.view(), {}), network.describe(image_.view(), {}));
}

TEST_F(PlaceNetworkTest, RefusesAFileThatIsNone) {
  const TinyNetwork tiny(1, 48, 64, 16);
  FeatureModel other{(scratch_.path() / "places.onnx").string(), 0};
  EXPECT_THAT([&] { PlaceNetwork{other}; }, ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened")));
  for (std::size_t length = 0; length < tiny.bytes().size(); length += 5) {
    std::ofstream(other.file, std::ios::binary) << tiny.bytes().substr(0, length);
    EXPECT_THAT([&] { PlaceNetwork{other}; }, ThrowsMessage<std::runtime_error>(HasSubstr("places.onnx"))) << length;
  }
  FeatureModel known = model(tiny);
  PlaceNetwork{known};
  EXPECT_NO_THROW(PlaceNetwork{known});
  ++known.crc32;
  EXPECT_THAT([&] { PlaceNetwork{known}; }, ThrowsMessage<std::runtime_error>(HasSubstr("checksum")));
}

TEST_F(PlaceNetworkTest, RefusesOtherShapes) {
  expectRefused({2, 48, 64, 16}, "no image");
  expectRefused({1, 16, 16, 16}, "1 numbers");
  expectRefused({1, 5000, 64, 16}, "larger than");
  FeatureModel of_any_size = model({1, 0, 0, 16});
  const PlaceNetwork network(of_any_size);
  EXPECT_THAT([&] { network.describe(image_.view(), {}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none of whole images")));
  EXPECT_THROW(network.describe({}, {}), std::invalid_argument);
  EXPECT_THROW(network.describe(image_.view(), {.rows_from_top = 48}), std::invalid_argument);
  EXPECT_THROW(network.describe(Image{7, 7, std::vector<uint8_t>(49)}.view(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

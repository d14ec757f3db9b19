// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scratch_directory.h"
#include "synthetic_texture.h"
#include "vmcl/vision/feature_matching.h"
#include "vmcl/vision/features.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct KnownModel {
  const char* file;
  int descriptor_bytes;
  float max_error_px;  ///< median of features of an image shifted by whole pixels
};

/// SuperPoint takes any image, XFeat's exports one size alone.
class NetworkFeaturesTest : public testing::TestWithParam<KnownModel> {
 protected:
  void SetUp() override {
    options_.kind = FeatureKind::network;
    options_.model.file = (std::filesystem::path(VMCL_SHARED_DIR) / "models" / GetParam().file).string();
    if (!std::filesystem::exists(options_.model.file)) GTEST_SKIP() << options_.model.file << " is not here";
  }

  FeatureOptions options_{.max_features = 400};
  CameraCalibration camera_ = centredCamera(327, 243);
  Image texture_ = rectangleTexture(327, 243, 3);
};

TEST_P(NetworkFeaturesTest, MoveWithTheImage) {
  const FeatureExtractor extractor(options_);
  EXPECT_NE(extractor.options().model.crc32, 0u);
  const FeatureSet there = extractor.extract(texture_.view(), camera_);
  const FeatureSet here = extractor.extract(shifted(texture_, 8, 16).view(), camera_);
  EXPECT_GT(there.size(), 100);
  EXPECT_LE(there.size(), 400);
  EXPECT_EQ(there.descriptors.cols(), GetParam().descriptor_bytes);
  EXPECT_TRUE(std::is_sorted(there.responses.rbegin(), there.responses.rend()));
  std::vector<float> errors;
  for (const FeatureMatch& match : matchFeatures(here, there, {}))
    errors.push_back((here.pixels[static_cast<std::size_t>(match.query)] -
                      there.pixels[static_cast<std::size_t>(match.reference)] - Eigen::Vector2f(8, 16))
                         .norm());
  ASSERT_GT(errors.size(), 50u);
  std::ranges::nth_element(errors, errors.begin() + std::ssize(errors) / 2);
  EXPECT_LT(errors[errors.size() / 2], GetParam().max_error_px);
}

TEST_P(NetworkFeaturesTest, BlankAndTinyImagesHaveNone) {
  const FeatureExtractor extractor(options_);
  for (uint8_t grey : {0, 90, 255})
    EXPECT_EQ(extractor.extract(Image{327, 243, std::vector<uint8_t>(327 * 243, grey)}.view(), camera_).size(), 0);
  EXPECT_EQ(extractor.extract(Image{9, 9, std::vector<uint8_t>(81, 7)}.view(), centredCamera(9, 9)).size(), 0);
}

TEST_P(NetworkFeaturesTest, TakeTheModelOfTheChecksumAlone) {
  options_.model.crc32 = FeatureExtractor(options_).options().model.crc32;
  EXPECT_NO_THROW(FeatureExtractor{options_});
  ++options_.model.crc32;
  EXPECT_THAT([&] { FeatureExtractor{options_}; }, ThrowsMessage<std::runtime_error>(HasSubstr("checksum")));
}

TEST_P(NetworkFeaturesTest, ACutOffModelIsRefused) {
  const ScratchDirectory scratch;
  std::ifstream in(options_.model.file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t length : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
    options_.model.file = (scratch.path() / "cut.onnx").string();
    std::ofstream(options_.model.file, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THAT([&] { FeatureExtractor{options_}; }, ThrowsMessage<std::runtime_error>(HasSubstr("cut.onnx")))
        << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, NetworkFeaturesTest,
                         testing::Values(KnownModel{"superpoint_mbv1.onnx", 256, 0.25f},
                                         KnownModel{"xfeat_320x224.onnx", 64, 1.5f}),
                         [](const auto& parameter) { return parameter.index == 0 ? "SuperPoint" : "XFeat"; });

TEST(NetworkModelTest, RefusesWhatIsNone) {
  const ScratchDirectory scratch;
  const auto refused = [&](const std::string& file, const char* reason) {
    FeatureOptions options;
    options.choose(file);
    EXPECT_THAT([&] { FeatureExtractor{options}; },
                ThrowsMessage<std::runtime_error>(testing::AllOf(HasSubstr(file), HasSubstr(reason))));
  };
  refused((scratch.path() / "missing.onnx").string(), "cannot be opened");
  std::filesystem::create_directory(scratch.path() / "folder.onnx");
  refused((scratch.path() / "folder.onnx").string(), "cannot be opened");
  std::ofstream(scratch.path() / "text.onnx") << "not a model at all, whatever its name says";
  refused((scratch.path() / "text.onnx").string(), "");
}

}  // namespace
}  // namespace vmcl

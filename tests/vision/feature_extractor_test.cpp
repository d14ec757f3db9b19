// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic_texture.h"
#include "vmcl/vision/features.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FeatureOptionsTest, ChooseByNameOrModel) {
  FeatureOptions options;
  for (FeatureKind kind : {FeatureKind::orb, FeatureKind::sift, FeatureKind::akaze}) {
    options.choose(nameOf(kind));
    EXPECT_EQ(options.kind, kind);
    EXPECT_NO_THROW(options.check());
  }
  options.choose("models/some.onnx");
  EXPECT_EQ(options.kind, FeatureKind::network);
  EXPECT_EQ(options.model, (FeatureModel{"models/some.onnx", 0}));
  options.choose("orb");
  EXPECT_EQ(options.model, FeatureModel());
  EXPECT_THAT([] { FeatureOptions().choose("surf"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("surf")));
}

TEST(FeatureOptionsTest, NameTheBadKey) {
  const auto expectRefused = [](const FeatureOptions& options, const char* key) {
    EXPECT_THAT([&] { FeatureExtractor{options}; }, ThrowsMessage<std::invalid_argument>(HasSubstr(key)));
  };
  expectRefused({.max_features = 0}, "max_features");
  expectRefused({.mask_rows_from_top = -1}, "mask_rows_from_top");
  expectRefused({.kind = static_cast<FeatureKind>(7)}, "kind");
  expectRefused({.kind = FeatureKind::network}, "model");
  expectRefused({.kind = FeatureKind::orb, .model = {"some.onnx", 0}}, "model");
}

class FeatureExtractorTest : public testing::TestWithParam<FeatureKind> {
 protected:
  FeatureOptions options_{.kind = GetParam(), .max_features = 400};
  CameraCalibration camera_ = centredCamera(320, 240);
  Image texture_ = rectangleTexture(320, 240, 3);

  FeatureSet extract(const Image& image) const { return FeatureExtractor(options_).extract(image.view(), camera_); }
};

void expectSame(const FeatureSet& a, const FeatureSet& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.sizes, b.sizes);
  EXPECT_EQ(a.responses, b.responses);
  EXPECT_EQ(a.descriptors, b.descriptors);
}

TEST_P(FeatureExtractorTest, FillsEveryField) {
  const FeatureSet features = extract(texture_);
  EXPECT_EQ(features.kind, GetParam());
  ASSERT_GT(features.size(), 100);
  ASSERT_LE(features.size(), 400);
  const auto count = static_cast<std::size_t>(features.size());
  EXPECT_EQ(features.sizes.size(), count);
  EXPECT_EQ(features.responses.size(), count);
  EXPECT_EQ(features.descriptors.rows(), features.size());
  EXPECT_TRUE(isDescriptorLength(GetParam(), features.descriptors.cols()));
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(camera_.pinhole.contains(features.pixels[i].cast<double>()));
    EXPECT_GT(features.sizes[i], 0);
    EXPECT_GT(features.descriptors.row(static_cast<Eigen::Index>(i)).cast<int>().sum(), 0);
  }
  EXPECT_TRUE(std::is_sorted(features.responses.rbegin(), features.responses.rend()));
}

TEST_P(FeatureExtractorTest, KeepsTheStrongest) {
  const FeatureSet many = extract(texture_);
  options_.max_features = 50;
  const FeatureSet few = extract(texture_);
  EXPECT_EQ(few.size(), 50);
  if (GetParam() == FeatureKind::sift) {  // ORB shares its features out among the pyramid's levels
    EXPECT_EQ(few.descriptors, many.descriptors.topRows(50));
  }
}

TEST_P(FeatureExtractorTest, SameBytesEachTimeWhateverTheThreads) {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const FeatureSet one = extract(texture_), again = extract(texture_);
  cv::setNumThreads(2);
  const FeatureSet two = extract(texture_);
  cv::setNumThreads(threads);
  expectSame(one, again);
  expectSame(one, two);
}

TEST_P(FeatureExtractorTest, GreyAsColourGivesTheSame) {
  std::vector<uint8_t> colour;
  for (uint8_t pixel : texture_.pixels) colour.insert(colour.end(), {pixel, pixel, pixel});
  const ImageView view{colour.data(), 320, 240, 3, 960};
  expectSame(extract(texture_), FeatureExtractor(options_).extract(view, camera_));
}

TEST_P(FeatureExtractorTest, RowsMayBePadded) {
  std::vector<uint8_t> padded(240 * 400, 17);
  for (int v = 0; v < 240; ++v) std::copy_n(texture_.pixels.begin() + v * 320, 320, padded.begin() + v * 400);
  const ImageView view{padded.data(), 320, 240, 1, 400};
  expectSame(extract(texture_), FeatureExtractor(options_).extract(view, camera_));
}

TEST_P(FeatureExtractorTest, MaskedRowsHaveNoSay) {
  options_.mask_rows_from_top = 80;
  const FeatureSet features = extract(texture_);
  ASSERT_GT(features.size(), 50);
  for (const Eigen::Vector2f& pixel : features.pixels) EXPECT_GE(pixel.y(), 79.5f);
  Image other = texture_;
  std::fill_n(other.pixels.begin(), 80 * 320, uint8_t{0});
  expectSame(features, extract(other));
}

TEST_P(FeatureExtractorTest, MaskedPixelsHaveNoSay) {
  options_.mask_rows_from_top = 20;
  Image mask{320, 240, std::vector<uint8_t>(320 * 240)}, other = texture_;
  for (int v = 100; v < 240; ++v)
    for (int u = 150; u < 320 - v / 4; ++u) {
      mask.pixels[static_cast<std::size_t>(320 * v + u)] = 255;
      other.pixels[static_cast<std::size_t>(320 * v + u)] ^= 0x55;
    }
  const FeatureExtractor extractor(options_);
  const FeatureSet features = extractor.extract(texture_.view(), camera_, {20, mask.view()});
  ASSERT_GT(features.size(), 50);
  for (int i = 0; i < features.size(); ++i) {
    const Eigen::Vector2f& pixel = features.pixels[static_cast<std::size_t>(i)];
    const float reach = features.sizes[static_cast<std::size_t>(i)] / 2;
    const Eigen::Vector2f inside = (pixel + reach * Eigen::Vector2f(200 - pixel.x(), 150 - pixel.y()).normalized());
    EXPECT_FALSE(inside.x() > 151 && inside.x() < 260 && inside.y() > 101) << pixel.transpose() << " reaches " << reach;
  }
  expectSame(features, extractor.extract(other.view(), camera_, {20, mask.view()}));
  const Image nothing_masked{320, 240, std::vector<uint8_t>(320 * 240, 127)};
  expectSame(extract(texture_), extractor.extract(texture_.view(), camera_, {20, nothing_masked.view()}));
  const Image all_masked{320, 240, std::vector<uint8_t>(320 * 240, 128)};
  EXPECT_EQ(extractor.extract(texture_.view(), camera_, {20, all_masked.view()}).size(), 0);
}

TEST_P(FeatureExtractorTest, BlankOrTinyImagesHaveNone) {
  EXPECT_EQ(extract(rectangleTexture(320, 240, 1, 0)).size(), 0);
  for (int side : {1, 2, 7, 15, 16, 33}) {
    camera_ = centredCamera(side, side);
    EXPECT_EQ(extract(rectangleTexture(side, side, 1, 0)).size(), 0) << side;
  }
}

TEST_P(FeatureExtractorTest, RefusesWhatDoesNotFitTheCamera) {
  const FeatureExtractor extractor(options_);
  const auto refused = [&](const ImageView& view, const char* reason) {
    EXPECT_THAT([&] { extractor.extract(view, camera_); }, ThrowsMessage<std::invalid_argument>(HasSubstr(reason)));
  };
  const uint8_t* pixels = texture_.pixels.data();
  refused({pixels, 240, 320, 1, 240}, "240 x 320");
  refused({}, "0 x 0");
  refused({pixels, 320, 240, 2, 640}, "2 channels");
  refused({pixels, 320, 240, 1, 319}, "319 bytes");
  const Image small_mask{240, 320, std::vector<uint8_t>(320 * 240)};
  EXPECT_THAT(
      [&] {
        extractor.extract(texture_.view(), camera_, {20, small_mask.view()});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("mask is 240 x 320")));
  options_.mask_rows_from_top = 240;
  EXPECT_THAT([&] { extract(texture_); }, ThrowsMessage<std::invalid_argument>(HasSubstr("mask_rows_from_top")));
}

/// A round blob, bright on dark, its centre anywhere between the pixels.
Image blob(const Eigen::Vector2d& centre, double sigma) {
  Image image{320, 240, std::vector<uint8_t>(320 * 240)};
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      image.pixels[static_cast<std::size_t>(v * 320 + u)] = static_cast<uint8_t>(
          std::lround(40 + 180 * std::exp(-(Eigen::Vector2d(u, v) - centre).squaredNorm() / (2 * sigma * sigma))));
  return image;
}

TEST(SiftFeaturesTest, AreWhereTheBlobIs) {
  for (double sigma : {2.0, 4.0, 8.0})
    for (const Eigen::Vector2d& centre : {Eigen::Vector2d(160, 120), Eigen::Vector2d(157.3, 118.6)}) {
      const FeatureSet features =
          FeatureExtractor({.kind = FeatureKind::sift}).extract(blob(centre, sigma).view(), centredCamera(320, 240));
      ASSERT_GE(features.size(), 1);
      EXPECT_LT((features.pixels[0].cast<double>() - centre).norm(), 0.08) << "sigma " << sigma;
    }
}

/// Mean difference between features and those of the image turned by half a turn, turned back: twice the bias.
Eigen::Vector2f meanShiftWhenTurned(const Image& image, FeatureKind kind, float min_size, int& pairs) {
  Image turned = image;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  const CameraCalibration camera = centredCamera(image.width, image.height);
  const FeatureExtractor extractor({.kind = kind, .max_features = 3000});
  const FeatureSet there = extractor.extract(image.view(), camera), back = extractor.extract(turned.view(), camera);
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  pairs = 0;
  for (std::size_t i = 0; i < there.pixels.size(); ++i)
    for (std::size_t j = 0; j < back.pixels.size(); ++j) {
      const Eigen::Vector2f turned_back =
          Eigen::Vector2f(static_cast<float>(image.width - 1), static_cast<float>(image.height - 1)) - back.pixels[j];
      const Eigen::Vector2f shift = there.pixels[i] - turned_back;
      if (there.sizes[i] < min_size || std::abs(there.sizes[i] / back.sizes[j] - 1) > 0.1f || shift.norm() > 4)
        continue;
      sum += shift;
      ++pairs;
    }
  return sum / static_cast<float>(pairs);
}

TEST_P(FeatureExtractorTest, PositionsHaveNoBias) {
  // Sides that the pyramid's levels do not divide.
  const Image image = rectangleTexture(317, 233, 9, 300);
  for (float min_size : {0.0f, 60.0f}) {
    if (GetParam() != FeatureKind::orb && min_size > 0) continue;  // the others have too few so large
    int pairs = 0;
    const Eigen::Vector2f shift = meanShiftWhenTurned(image, GetParam(), min_size, pairs);
    EXPECT_GT(pairs, 100);
    EXPECT_LT(shift.cwiseAbs().maxCoeff(), 0.15f) << shift.transpose() << " of size " << min_size;
  }
}

// What a distorted camera shows of a scene of blobs is found where the ideal camera would show it.
TEST(DistortedCameraTest, PixelsAreIdeal) {
  CameraCalibration camera = centredCamera(640, 480, 400);
  camera.distortion = {-0.25, 0.06, 0.001, -0.0005, 0};
  std::vector<Eigen::Vector2d> ideal;
  Image image{640, 480, std::vector<uint8_t>(640 * 480, 60)};
  for (int v = 60; v < 450; v += 60)
    for (int u = 50; u < 620; u += 60) {
      const Eigen::Vector2d pixel(u + 0.3, v - 0.2), seen = camera.distort(pixel);
      ideal.push_back(pixel);
      for (int y = static_cast<int>(seen.y()) - 12; y <= seen.y() + 12; ++y)
        for (int x = static_cast<int>(seen.x()) - 12; x <= seen.x() + 12; ++x)
          image.pixels[static_cast<std::size_t>(y * 640 + x)] = static_cast<uint8_t>(
              std::lround(60 + 150 * std::exp(-(Eigen::Vector2d(x, y) - seen).squaredNorm() / 18)));
    }
  const FeatureSet features = FeatureExtractor({.kind = FeatureKind::sift}).extract(image.view(), camera);
  int found = 0;
  for (const Eigen::Vector2d& pixel : ideal)
    found += std::any_of(features.pixels.begin(), features.pixels.end(), [&](const Eigen::Vector2f& feature) {
      return (feature.cast<double>() - pixel).norm() < 0.15;
    });
  EXPECT_EQ(found, static_cast<int>(ideal.size()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, FeatureExtractorTest,
                         testing::Values(FeatureKind::orb, FeatureKind::sift, FeatureKind::akaze),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

}  // namespace
}  // namespace vmcl

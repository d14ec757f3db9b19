// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "synthetic_texture.h"

namespace vmcl {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class ReadImage : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "/vmcl_read_image_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string encoded(const std::string& extension) const {
    const Image texture = rectangleTexture(61, 47, 5);
    std::vector<uint8_t> bytes;
    cv::imencode(extension, cv::Mat(47, 61, CV_8U, const_cast<uint8_t*>(texture.pixels.data())), bytes);
    return {bytes.begin(), bytes.end()};
  }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  static void expectRefused(const std::string& file, const std::string& reason) {
    EXPECT_THAT([&] { readImage(file); }, ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(file), HasSubstr(reason))));
  }

  std::filesystem::path folder_;
};

TEST_F(ReadImage, PngComesBackTheSame) {
  const Image image = readImage(write("a.png", encoded(".png")));
  EXPECT_EQ(image.width, 61);
  EXPECT_EQ(image.height, 47);
  EXPECT_EQ(image.pixels, rectangleTexture(61, 47, 5).pixels);
}

TEST_F(ReadImage, JpegHasTheSize) {
  const Image image = readImage(write("a.jpg", encoded(".jpg")));
  EXPECT_EQ(image.width, 61);
  EXPECT_EQ(image.height, 47);
  EXPECT_EQ(image.pixels.size(), 61u * 47u);
}

TEST_F(ReadImage, ColourBecomesGrey) {
  cv::imwrite(path("colour.png"), cv::Mat(20, 30, CV_8UC3, cv::Scalar(200, 200, 200)));
  const Image image = readImage(path("colour.png"));
  EXPECT_EQ(image.pixels, std::vector<uint8_t>(600, 200));
}

TEST_F(ReadImage, MissingFileOrFolderIsNamed) {
  expectRefused(path("missing.png"), "cannot be opened");
  expectRefused(folder_.string(), "");
}

TEST_F(ReadImage, WhatIsNoImageIsNamed) {
  expectRefused(write("empty.png", ""), "neither a PNG nor a JPEG");
  expectRefused(write("text.jpg", "not an image"), "neither a PNG nor a JPEG");
}

TEST_F(ReadImage, EveryCutIsNoticed) {
  for (const char* extension : {".png", ".jpg"}) {
    const std::string whole = encoded(extension);
    for (std::size_t size = 0; size < whole.size() - 2; size += 13)
      EXPECT_THROW(readImage(write("cut", whole.substr(0, size))), std::runtime_error) << extension << " at " << size;
  }
}

// Damaged bytes may still decode to something; they must never do anything worse than throw.
TEST_F(ReadImage, DamageIsSurvived) {
  Random random(7);
  for (const char* extension : {".png", ".jpg"}) {
    const std::string whole = encoded(extension);
    for (int trial = 0; trial < 50; ++trial) {
      std::string damaged = whole;
      for (int i = 0; i < 5; ++i)
        damaged[random.below(static_cast<uint32_t>(whole.size()))] = static_cast<char>(random.below(256));
      try {
        const Image image = readImage(write("damaged", damaged));
        EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
      } catch (const std::runtime_error&) {
      }
    }
  }
}

TEST_F(ReadImage, HugeImagesAreRefusedByTheirHeaders) {
  std::string png = encoded(".png");
  png.replace(16, 8, std::string("\x00\x00\x40\x00\x00\x00\x40\x00", 8));  // 16384 x 16384
  expectRefused(write("huge.png", png), "16384 x 16384");

  std::string jpeg = encoded(".jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, jpeg.npos);
  jpeg.replace(frame + 5, 4, "\xff\xff\xff\xff");
  expectRefused(write("huge.jpg", jpeg), "65535 x 65535");
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace vmcl {

/// Somebody else's pixels, 8 bit, rows from the top, one channel (grey) or three (BGR).
struct ImageView {
  const uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  int channels = 1;
  std::size_t row_bytes = 0;

  bool empty() const { return pixels == nullptr || width <= 0 || height <= 0; }
};

/// An owned grey image.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> pixels;

  ImageView view() const { return {pixels.data(), width, height, 1, static_cast<std::size_t>(width)}; }
};

/// An owned grey image of 16 bit, as depth cameras give.
struct Image16 {
  int width = 0;
  int height = 0;
  std::vector<uint16_t> pixels;
};

/// Reads a PNG or JPEG file as grey; an orientation tag is ignored, since calibrations speak of the pixels as stored.
/// Throws std::runtime_error naming the file: missing, no such image, cut off, or more than 100 megapixels.
Image readImage(const std::filesystem::path& file);

/// The same of a file with 16 bit grey values; others are refused too.
Image16 readImage16(const std::filesystem::path& file);

/// The same of a BGR image, 8 bit, rows from the top.
struct ColourImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> pixels;  ///< BGR

  ImageView view() const { return {pixels.data(), width, height, 3, static_cast<std::size_t>(3 * width)}; }
};
ColourImage readColourImage(const std::filesystem::path& file);

/// Writes a grey or BGR image as PNG, aside and renamed. Throws std::runtime_error naming the file.
void writePng(const std::filesystem::path& file, const ImageView& image);

/// An image as grey JPEG of high quality, and back. compressImage throws std::invalid_argument for an empty image,
/// decompressImage std::runtime_error for bytes that are none.
std::vector<uint8_t> compressImage(const ImageView& image);
Image decompressImage(const std::vector<uint8_t>& bytes);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/image.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

constexpr uint64_t max_image_pixels = 100'000'000;
constexpr uint64_t max_file_bytes = 4 * max_image_pixels;

struct ImageSize {
  uint64_t width = 0;
  uint64_t height = 0;
};

uint64_t bigEndian(std::string_view bytes) {
  uint64_t value = 0;
  for (char byte : bytes) value = value << 8 | static_cast<uint8_t>(byte);
  return value;
}

/// PNG: the IHDR chunk comes first.
ImageSize pngSize(std::string_view bytes) {
  if (bytes.size() < 24 || bytes.substr(12, 4) != "IHDR") throw std::runtime_error("broken PNG header");
  if (bytes.find("IEND") == bytes.npos) throw std::runtime_error("PNG is cut off");
  return {bigEndian(bytes.substr(16, 4)), bigEndian(bytes.substr(20, 4))};
}

/// JPEG: walks the segments to the frame header (SOF0 to SOF15 without DHT, JPG and DAC).
ImageSize jpegSize(std::string_view bytes) {
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != '\xff') break;
    const auto marker = static_cast<uint8_t>(bytes[at + 1]);
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {
      // Image data holds no end marker but the last; the decoder would fill what is missing with grey.
      if (bytes.find("\xff\xd9", at) == bytes.npos) throw std::runtime_error("JPEG is cut off");
      return {bigEndian(bytes.substr(at + 7, 2)), bigEndian(bytes.substr(at + 5, 2))};
    }
    at += 2 + bigEndian(bytes.substr(at + 2, 2));
  }
  throw std::runtime_error("broken JPEG header");
}

ImageSize imageSize(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return pngSize(bytes);
  if (bytes.starts_with("\xff\xd8")) return jpegSize(bytes);
  throw std::runtime_error("neither a PNG nor a JPEG image");
}

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be opened");
  if (std::filesystem::is_directory(file)) throw std::runtime_error("is a directory");
  const uint64_t size = std::filesystem::file_size(file);
  if (size > max_file_bytes) throw std::runtime_error("larger than any image of 100 megapixels");
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) throw std::runtime_error("cannot be read");
  return bytes;
}

cv::Mat decode(const std::string& bytes, int mode) {
  const ImageSize size = imageSize(bytes);
  if (size.width * size.height > max_image_pixels)
    throw std::runtime_error("image of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                             " pixels; at most 100 megapixels are read");
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  // An orientation tag would turn the pixels away from the calibration.
  const cv::Mat image = cv::imdecode(encoded, mode | cv::IMREAD_IGNORE_ORIENTATION);
  if (image.empty()) throw std::runtime_error("image data is broken");
  return image;
}

Image decodeGrey(const std::string& bytes) {
  const cv::Mat grey = decode(bytes, cv::IMREAD_GRAYSCALE);
  return {grey.cols, grey.rows, std::vector<uint8_t>(grey.begin<uint8_t>(), grey.end<uint8_t>())};
}

cv::Mat matrixOf(const ImageView& image) {
  return {image.height, image.width, image.channels == 1 ? CV_8UC1 : CV_8UC3, const_cast<uint8_t*>(image.pixels),
          image.row_bytes};
}

}  // namespace

Image readImage(const std::filesystem::path& file) {
  try {
    return decodeGrey(readBytes(file));
  } catch (const std::exception& error) {  // also what OpenCV throws
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

ColourImage readColourImage(const std::filesystem::path& file) try {
  const cv::Mat image = decode(readBytes(file), cv::IMREAD_COLOR);
  return {image.cols, image.rows, std::vector<uint8_t>(image.datastart, image.dataend)};
} catch (const std::exception& error) {
  throw std::runtime_error(file.string() + ": " + error.what());
}

Image16 readImage16(const std::filesystem::path& file) try {
  const cv::Mat image = decode(readBytes(file), cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1) throw std::runtime_error("not an image of 16 bit depth");
  return {image.cols, image.rows, std::vector<uint16_t>(image.begin<uint16_t>(), image.end<uint16_t>())};
} catch (const std::exception& error) {
  throw std::runtime_error(file.string() + ": " + error.what());
}

void writePng(const std::filesystem::path& file, const ImageView& image) {
  if (image.empty()) throw std::invalid_argument("no image to write");
  std::vector<uint8_t> bytes;
  cv::imencode(".png", matrixOf(image), bytes);
  AtomicFile out(file);
  out.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.commit();
}

std::vector<uint8_t> compressImage(const ImageView& image) {
  if (image.empty()) throw std::invalid_argument("no image to compress");
  cv::Mat pixels = matrixOf(image);
  if (image.channels != 1) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2GRAY);
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  return bytes;
}

Image decompressImage(const std::vector<uint8_t>& bytes) try {
  return decodeGrey(std::string(bytes.begin(), bytes.end()));
} catch (const cv::Exception& error) {
  throw std::runtime_error(error.err);
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace vmcl {

/// An ONNX file made by hand, in protocol buffers' wire format: a network without weights that takes images of
/// 1 x channels x height x width; 0: any height and width.
class TinyNetwork {
 public:
  /// Gives the mean of each `pool` x `pool` pixels.
  TinyNetwork(int channels, int height, int width, int pool)
      : bytes_(model(field(1, means("image", "means", pool)) +
                     field(11, tensor("image", {1, channels, height, width})) +
                     field(12, tensor("means", {1, channels, 0, 0})))) {}

  /// Takes two images and gives the means of the second, twice as many channels as it has, and those of the first.
  static TinyNetwork ofTwoImages(int channels, int height, int width, int pool) {
    const std::string axis = field(1, "axis") + number(3, 1) + number(20, 2);
    const std::string twice =
        field(1, "means") + field(1, "means") + field(2, "places") + field(4, "Concat") + field(5, axis);
    return TinyNetwork(model(field(1, means("reference", "sure", pool)) + field(1, means("query", "means", pool)) +
                             field(1, twice) + field(11, tensor("reference", {1, channels, height, width})) +
                             field(11, tensor("query", {1, channels, height, width})) +
                             field(12, tensor("places", {1, 2 * channels, 0, 0})) +
                             field(12, tensor("sure", {1, channels, 0, 0}))));
  }

  const std::string& bytes() const { return bytes_; }

  std::string writtenTo(const std::filesystem::path& file) const {
    std::ofstream(file, std::ios::binary) << bytes_;
    return file.string();
  }

 private:
  explicit TinyNetwork(std::string bytes) : bytes_(std::move(bytes)) {}

  static std::string model(const std::string& graph) {
    return number(1, 7) + field(7, graph + field(2, "tiny")) + field(8, field(1, "") + number(2, 11));
  }

  static std::string means(std::string_view input, std::string_view output, int pool) {
    const std::string kernel = field(1, "kernel_shape") + number(8, pool) + number(8, pool) + number(20, 7);
    const std::string strides = field(1, "strides") + number(8, pool) + number(8, pool) + number(20, 7);
    return field(1, input) + field(2, output) + field(4, "AveragePool") + field(5, kernel) + field(5, strides);
  }

  static std::string varint(unsigned value) {
    std::string bytes;
    for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
    return bytes + static_cast<char>(value);
  }

  static std::string number(int key, int value) {
    return varint(static_cast<unsigned>(key) << 3) + varint(static_cast<unsigned>(value));
  }

  static std::string field(int key, std::string_view bytes) {
    return varint(static_cast<unsigned>(key) << 3 | 2) + varint(static_cast<unsigned>(bytes.size())).append(bytes);
  }

  static std::string tensor(std::string_view name, const std::array<int, 4>& shape) {
    std::string dimensions;
    for (const int size : shape) dimensions += field(1, size > 0 ? number(1, size) : field(2, "free"));
    return field(1, name) + field(2, field(1, number(1, 1) + field(2, dimensions)));
  }

  std::string bytes_;
};

}  // namespace vmcl

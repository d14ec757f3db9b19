// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace vmcl {

static_assert(std::endian::native == std::endian::little, "map files are little endian");

/// Appends numbers to a string as they lie in memory.
class ByteWriter {
 public:
  template <typename T>
  void put(T value) {
    putAll(std::span<const T>(&value, 1));
  }

  template <typename T>
  void putAll(std::span<const T> values) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }

  void putCount(std::size_t count) { put(static_cast<uint32_t>(count)); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads back what ByteWriter wrote. Throws std::runtime_error rather than read past the end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T get() {
    T value;
    getAll(std::span<T>(&value, 1));
    return value;
  }

  template <typename T>
  void getAll(std::span<T> values) {
    static_assert(std::is_arithmetic_v<T>);
    require(values.size_bytes());
    if (!values.empty()) std::memcpy(values.data(), bytes_.data(), values.size_bytes());
    bytes_.remove_prefix(values.size_bytes());
  }

  /// A count of things that take at least `bytes_each` of what remains, so that memory for them may be taken.
  std::size_t getCount(std::size_t bytes_each) {
    const std::size_t count = get<uint32_t>();
    require(count * bytes_each);
    return count;
  }

  /// Throws unless that many bytes remain.
  void require(std::size_t bytes) const {
    if (bytes > bytes_.size()) throw std::runtime_error("cut off");
  }

  std::string_view remaining() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace vmcl

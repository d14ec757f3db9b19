// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <cstring>
#include <string>
#include <vector>

namespace vmcl {

/// A message of ROS 1 being put together field by field, as it goes over the wire.
struct RosMessage {
  std::string type;
  std::string md5;
  std::vector<uint8_t> bytes;

  template <class T>
  RosMessage& put(const T& value) {
    const auto* first = reinterpret_cast<const uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
    return *this;
  }
  template <class T>
  RosMessage& array(const std::vector<T>& values) {
    put(static_cast<uint32_t>(values.size()));
    for (const T& value : values) put(value);
    return *this;
  }
  RosMessage& text(const std::string& letters) { return array(std::vector<char>(letters.begin(), letters.end())); }
  RosMessage& numbers(const std::vector<double>& values) {
    for (const double value : values) put(value);
    return *this;
  }
  RosMessage& header(double time, const std::string& frame) {
    const auto seconds = static_cast<uint32_t>(time);
    put(uint32_t{0}).put(seconds).put(static_cast<uint32_t>((time - seconds) * 1e9));
    return text(frame);
  }
};

}  // namespace vmcl

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<vmcl::RosMessage> {
  static const char* value(const vmcl::RosMessage& m) { return m.md5.c_str(); }
};
template <>
struct DataType<vmcl::RosMessage> {
  static const char* value(const vmcl::RosMessage& m) { return m.type.c_str(); }
};
template <>
struct Definition<vmcl::RosMessage> {
  static const char* value(const vmcl::RosMessage&) { return ""; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<vmcl::RosMessage> {
  template <class Stream>
  static void write(Stream& stream, const vmcl::RosMessage& m) {
    std::memcpy(stream.advance(static_cast<uint32_t>(m.bytes.size())), m.bytes.data(), m.bytes.size());
  }
  static uint32_t serializedLength(const vmcl::RosMessage& m) { return static_cast<uint32_t>(m.bytes.size()); }
};
}  // namespace serialization
}  // namespace ros

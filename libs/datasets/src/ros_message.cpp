// SPDX-License-Identifier: BSD-3-Clause
#include "ros_message.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace vmcl {
namespace {

class RosBytes {
 public:
  explicit RosBytes(std::span<const uint8_t> bytes) : rest_(bytes) {}

  template <class T>
  T value() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  template <class T>
  std::vector<T> values(std::size_t count) {
    if (count > rest_.size() / sizeof(T)) throw std::runtime_error("the message is cut off");
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
    return values;
  }

  template <class T>
  std::vector<T> array() {
    return values<T>(value<uint32_t>());
  }

  std::string text() {
    const auto letters = array<char>();
    return {letters.begin(), letters.end()};
  }

  RosHeader header() {
    value<uint32_t>();  // seq
    RosHeader header;
    const auto seconds = value<uint32_t>(), nanoseconds = value<uint32_t>();
    header.time = seconds + 1e-9 * nanoseconds;
    header.frame = text();
    if (header.frame.starts_with('/')) header.frame.erase(0, 1);
    return header;
  }

  Rigid3 pose() {
    const auto p = values<double>(3), q = values<double>(4);
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    Rigid3 pose = Rigid3::Identity();
    pose.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
    if (!pose.translation().allFinite() || !(rotation.norm() > 1e-6 && std::isfinite(rotation.norm())))
      throw std::runtime_error("a pose is none");
    pose.linear() = rotation.normalized().toRotationMatrix();
    return pose;
  }

 private:
  std::span<const uint8_t> take(std::size_t count) {
    if (count > rest_.size()) throw std::runtime_error("the message is cut off");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::span<const uint8_t> rest_;
};

}  // namespace

RosImage readRosImage(std::span<const uint8_t> bytes) {
  RosBytes in(bytes);
  RosImage image;
  image.header = in.header();
  image.height = in.value<uint32_t>();
  image.width = in.value<uint32_t>();
  image.encoding = in.text();
  in.value<uint8_t>();  // is_bigendian
  image.step = in.value<uint32_t>();
  image.data = in.array<uint8_t>();
  if (image.data.size() < std::size_t{image.height} * image.step) throw std::runtime_error("the image is cut off");
  return image;
}

RosCameraInfo readRosCameraInfo(std::span<const uint8_t> bytes) {
  RosBytes in(bytes);
  in.header();
  RosCameraInfo info;
  info.height = in.value<uint32_t>();
  info.width = in.value<uint32_t>();
  info.distortion_model = in.text();
  info.distortion = in.array<double>();
  info.matrix = in.values<double>(9);
  return info;
}

RosOdometry readRosOdometry(std::span<const uint8_t> bytes) {
  RosBytes in(bytes);
  RosOdometry odometry;
  odometry.header = in.header();
  in.text();  // child_frame_id
  odometry.odom_from_robot = in.pose();
  return odometry;
}

RosScan readRosScan(std::span<const uint8_t> bytes) {
  RosBytes in(bytes);
  RosScan scan;
  scan.header = in.header();
  scan.angle_min = in.value<float>();
  in.value<float>();  // angle_max
  scan.angle_increment = in.value<float>();
  in.value<float>();  // time_increment
  in.value<float>();  // scan_time
  scan.range_min = in.value<float>();
  scan.range_max = in.value<float>();
  scan.ranges = in.array<float>();
  for (const float value : {scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max})
    if (!std::isfinite(value)) throw std::runtime_error("the scan's geometry is not finite");
  if (scan.ranges.size() < 2 || scan.angle_increment == 0) throw std::runtime_error("the scan is empty");
  return scan;
}

std::vector<RosTransform> readRosTransforms(std::span<const uint8_t> bytes) {
  RosBytes in(bytes);
  std::vector<RosTransform> transforms;
  for (auto count = in.value<uint32_t>(); count > 0; --count) {
    RosTransform transform;
    transform.header = in.header();
    transform.child = in.text();
    if (transform.child.starts_with('/')) transform.child.erase(0, 1);
    transform.parent_from_child = in.pose();
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

// The messages of ROS 1 that a bag of a robot's drive holds, as far as they matter here. Each is read from its wire
// format (little endian, http://wiki.ros.org/msg); std::runtime_error for one that is cut off or holds what is not
// finite.

struct RosHeader {
  double time = 0;  ///< s
  std::string frame;
};

struct RosImage {
  RosHeader header;
  uint32_t height = 0;
  uint32_t width = 0;
  std::string encoding;
  uint32_t step = 0;
  std::vector<uint8_t> data;
};

struct RosCameraInfo {
  uint32_t height = 0;
  uint32_t width = 0;
  std::string distortion_model;
  std::vector<double> distortion;
  std::vector<double> matrix;  ///< 3x3, row-major
};

struct RosOdometry {
  RosHeader header;
  Rigid3 odom_from_robot = Rigid3::Identity();
};

struct RosScan {
  RosHeader header;
  float angle_min = 0;
  float angle_increment = 0;
  float range_min = 0;
  float range_max = 0;
  std::vector<float> ranges;
};

struct RosTransform {
  RosHeader header;  ///< its frame is the parent
  std::string child;
  Rigid3 parent_from_child = Rigid3::Identity();
};

RosImage readRosImage(std::span<const uint8_t> bytes);
RosCameraInfo readRosCameraInfo(std::span<const uint8_t> bytes);
RosOdometry readRosOdometry(std::span<const uint8_t> bytes);
RosScan readRosScan(std::span<const uint8_t> bytes);
std::vector<RosTransform> readRosTransforms(std::span<const uint8_t> bytes);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <string>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// How far the robot has moved since each of its sensors was used last, as AMCL reckons for each laser: sensors that
/// see at one place and time are all news.
class WaySinceUse {
 public:
  void add(const PlanarPose& movement) {
    for (auto& [sensor, way] : ways_) way = way * movement;
  }

  /// Of a sensor never used: any.
  bool isOver(const std::string& sensor, double distance, double angle) const {
    const auto known = ways_.find(sensor);
    if (known == ways_.end() || (distance == 0 && angle == 0)) return true;
    const auto& [x, y, phi] = known->second;
    return std::abs(x) > distance || std::abs(y) > distance || std::abs(phi) > angle;
  }

  void use(const std::string& sensor) { ways_[sensor] = {}; }
  void clear() { ways_.clear(); }

 private:
  std::map<std::string, PlanarPose> ways_;  ///< by label, in the robot frame of then
};

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// A floor that is not quite level: its slope wanders smoothly over a metre or two, by `sigma` (rad, standard deviation
/// along each axis), the same for every drive over it.
class FloorSlope {
 public:
  FloorSlope(double sigma, uint64_t seed);

  /// The pose of a robot on this floor, tilted about the place it stands on.
  Rigid3 tilted(const PlanarPose& map_from_robot) const;

 private:
  struct Wave {
    double along_x, along_y, phase;  // rad/m, rad
  };
  double at(const Wave* waves, double x, double y) const;

  static constexpr int count_ = 4;
  double sigma_;
  Wave pitch_[count_];
  Wave roll_[count_];
};

}  // namespace vmcl

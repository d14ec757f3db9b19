// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// Ground truth along x at 1 m/s from t = 0 to 10 s, a pose each 0.1 s.
inline Trajectory straightDrive() {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 100; ++i) poses.push_back({i * 0.1, toRigid3({i * 0.1, 0, 0})});
  return Trajectory(std::move(poses));
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {

/// Reads {x, y, z, yaw_deg, pitch_deg, roll_deg}: where a sensor sits on the robot, axes as the robot's (x forward).
inline mrpt::poses::CPose3D readMount(YamlMap yaml) {
  const mrpt::poses::CPose3D mount(yaml.get("x", 0.0), yaml.get("y", 0.0), yaml.get("z", 0.0),
                                   yaml.get("yaw_deg", 0.0) * degree, yaml.get("pitch_deg", 0.0) * degree,
                                   yaml.get("roll_deg", 0.0) * degree);
  yaml.finish();
  return mount;
}

/// From axes like the robot's to a camera's optical axes (x right, y down, z forward).
inline mrpt::poses::CPose3D opticalAxes() { return {0, 0, 0, -std::numbers::pi / 2, 0, -std::numbers::pi / 2}; }

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <filesystem>
#include <string>
#include <vector>

#include "drive.h"
#include "laser_scanner.h"
#include "scene.h"
#include "surface_painter.h"
#include "vmcl/geometry/camera.h"
#include "wheel_odometry.h"

namespace vmcl {

struct SimulatedCamera {
  double rate = 6;  ///< Hz
  PinholeCamera pinhole;
  mrpt::poses::CPose3D robot_from_camera;  ///< optical axes
  double sigma_grey = 2;                   ///< standard deviation of a pixel's brightness, of 255
};

struct SimulatedLaser {
  double rate = 6;  ///< Hz
  LaserModel model;
  mrpt::poses::CPose3D robot_from_laser;  ///< level
};

struct SimulatedOdometry {
  double rate = 20;  ///< Hz
  OdometryNoise noise;
};

/// One drive through the scene.
struct Session {
  PlanarPose start;
  std::vector<Eigen::Vector2d> waypoints;
  Light light;
};

/// All of a scene file, with one of its sessions.
struct SimulationSetup {
  uint64_t texture_seed = 1;
  Scene scene;
  RobotModel robot;
  SimulatedCamera camera;
  SimulatedLaser laser;
  SimulatedOdometry odometry;
  Session session;
};

/// Throws std::runtime_error naming file, line and key, or the sessions there are if this one is not among them.
SimulationSetup readSimulationSetup(const std::filesystem::path& file, const std::string& session);

}  // namespace vmcl

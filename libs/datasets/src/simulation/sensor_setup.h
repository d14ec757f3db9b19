// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

#include "drive.h"
#include "laser_scanner.h"
#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/yaml_map.h"
#include "wheel_odometry.h"

namespace vmcl {

/// The depth image of an RGB-D camera.
struct SimulatedDepth {
  double max_range = 8;   ///< m
  double sigma = 0.0015;  ///< standard deviation at a metre (m); grows with the square of the distance
};

struct SimulatedCamera {
  std::string label = "camera";
  double rate = 6;  ///< Hz
  CameraCalibration calibration;
  mrpt::poses::CPose3D robot_from_camera;  ///< optical axes
  double sigma_grey = 2;                   ///< standard deviation of a pixel's brightness, of 255
  double exposure_time = 0;                ///< s over which the robot's turning blurs the image
  double sigma_gain = 0;                   ///< standard deviation of the wandering logarithm of the brightness
  std::optional<SimulatedDepth> depth;
  double stereo_baseline = 0;  ///< m; a second camera so far to its right takes images with it; 0: none does
};

struct SimulatedLaser {
  double rate = 6;  ///< Hz
  LaserModel model;
  mrpt::poses::CPose3D robot_from_laser;
};

struct SimulatedOdometry {
  double rate = 20;  ///< Hz
  OdometryNoise noise;
};

/// What drives, and what it measures with.
struct RobotSetup {
  RobotModel robot;
  double tilt = 0;  ///< standard deviation of the floor's slope (rad)
  std::vector<SimulatedCamera> cameras;
  std::optional<SimulatedLaser> laser;
  SimulatedOdometry odometry;
};

/// Reads robot, camera or cameras, laser and odometry; a file without any of them gets a robot with one camera and a
/// laser. A camera with a `stereo_baseline` is two, LABEL_left and LABEL_right, unless `stereo` joins their images.
/// Throws std::runtime_error naming file, line and key.
RobotSetup readRobotSetup(YamlMap& yaml);

}  // namespace vmcl

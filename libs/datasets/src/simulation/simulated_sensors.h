// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <opencv2/core.hpp>

#include "floor_slope.h"
#include "image_formation.h"
#include "simulation_setup.h"
#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// What a camera took: the observation without its images, and these.
struct CameraShot {
  mrpt::obs::CObservationImage observation;
  cv::Mat bgr;
  cv::Mat depth_mm;            ///< 16 bit; empty for a camera without depth
  cv::Mat right_bgr;           ///< empty but for a stereo camera
  double stereo_baseline = 0;  ///< m
};

/// What the sensors of a setup measure along a true path. The noise of laser and cameras depends on seed and time
/// alone; odometry and the cameras' gains wander and want to be asked in order.
class SimulatedSensors {
 public:
  /// Throws std::runtime_error when off-screen drawing is not possible.
  SimulatedSensors(const SimulationSetup& setup, const Trajectory& path, uint64_t seed);

  /// True pose at a time of the path, with the tilt of the floor.
  Rigid3 truth(double time) const;

  mrpt::obs::CObservationOdometry odometry(double time);
  mrpt::obs::CObservation2DRangeScan laser(double time) const;
  CameraShot camera(std::size_t number, double time);

 private:
  /// Brightness that wanders around 1 (an Ornstein-Uhlenbeck process of its logarithm).
  struct Gain {
    Random random;
    double time = 0;
    double logarithm = 0;
  };

  double nextGain(std::size_t number, double time);
  Eigen::Vector3d turnRate(const SimulatedCamera& camera, double time) const;

  const SimulationSetup& setup_;
  const Trajectory& path_;
  uint64_t seed_;
  FloorSlope slope_;
  WheelOdometry odometry_;
  Crowd crowd_;
  std::vector<Triangle> triangles_;
  std::vector<ImageFormation> formations_;
  std::vector<Gain> gains_;
  SceneRenderer renderer_;
};

}  // namespace vmcl

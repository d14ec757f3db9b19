// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <opencv2/core.hpp>

#include "scene_renderer.h"
#include "simulation_setup.h"

namespace vmcl {

/// What the sensors of a setup measure at a true pose. The noise of laser and camera depends on seed and time alone;
/// odometry adds up and wants to be asked in order.
class SimulatedSensors {
 public:
  /// Throws std::runtime_error when off-screen drawing is not possible.
  SimulatedSensors(const SimulationSetup& setup, uint64_t seed);

  mrpt::obs::CObservationOdometry odometry(double time, const PlanarPose& map_from_robot);
  mrpt::obs::CObservation2DRangeScan laser(double time, const PlanarPose& map_from_robot) const;

  /// The observation without its image, and the image (BGR).
  mrpt::obs::CObservationImage camera(double time) const;
  cv::Mat image(double time, const PlanarPose& map_from_robot);

 private:
  const SimulationSetup& setup_;
  uint64_t seed_;
  WheelOdometry odometry_;
  SceneRenderer renderer_;
};

}  // namespace vmcl

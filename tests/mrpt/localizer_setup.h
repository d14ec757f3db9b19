// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationOdometry.h>

#include <optional>

#include "fake_camera_map.h"
#include "filter_setup.h"
#include "vmcl/mrpt/localizer.h"

namespace vmcl {

inline mrpt::maps::CMultiMetricMap::Ptr mapsWith(const std::shared_ptr<FakeMap>& map) {
  auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(map);
  return maps;
}

/// All particles at (1, 2, 0), and little noise: by the default motion model with 200 particles a mean of 1 m of
/// movement is known to 0.7 mm. Everything random follows the seed, 1 here and in amclOptions().
inline LocalizationConfig trackingConfig() {
  LocalizationConfig config;
  config.particles_count = 200;
  config.start = {1, 1, 2, 2, 0, 0};
  config.motion_model.gaussianModel.minStdXY = 0.001;
  config.motion_model.gaussianModel.minStdPHI = 0.001;
  config.localized.min_frames = 2;
  return config;
}

/// AMCL's, with little noise.
inline LocalizerOptions amclOptions() {
  LocalizerOptions amcl = LocalizerOptions::amcl();
  for (double* alpha : {&amcl.monte_carlo.motion_model->alpha1, &amcl.monte_carlo.motion_model->alpha2,
                        &amcl.monte_carlo.motion_model->alpha3, &amcl.monte_carlo.motion_model->alpha4})
    *alpha = 1e-4;
  return amcl;
}

inline std::shared_ptr<FakeMap> flatMap() {
  return std::make_shared<FakeMap>([](const PlanarPose&) { return 0; });
}

inline mrpt::obs::CObservation::Ptr commentAt(double time) {
  auto observation = mrpt::obs::CObservationComment::Create();
  observation->timestamp = mrpt::Clock::fromDouble(time);
  return observation;
}

inline mrpt::obs::CObservation::Ptr odometry(double x, std::optional<double> time = std::nullopt) {
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->odometry = mrpt::poses::CPose2D(x, 0, 0);
  if (time) observation->timestamp = mrpt::Clock::fromDouble(*time);
  return observation;
}

inline mrpt::obs::CSensoryFrame::Ptr someFrame() {
  return std::make_shared<mrpt::obs::CSensoryFrame>(someObservation());
}

}  // namespace vmcl

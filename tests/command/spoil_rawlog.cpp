// SPDX-License-Identifier: BSD-3-Clause
//
// usage: spoil_rawlog IN.rawlog HOW OUT.rawlog
// Copies a log and spoils it on the way, HOW being one of the names in `spoilers`.
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>

namespace {

using namespace mrpt::obs;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using SpoilImage = std::function<void(mrpt::img::CImage&, mrpt::img::TCamera&)>;

void spoilCamera(CObservation& observation, const SpoilImage& spoil) {
  if (auto* camera = dynamic_cast<CObservationImage*>(&observation)) spoil(camera->image, camera->cameraParams);
  if (auto* depth_camera = dynamic_cast<CObservation3DRangeScan*>(&observation)) {
    spoil(depth_camera->intensityImage, depth_camera->cameraParamsIntensity);
    depth_camera->cameraParams = depth_camera->cameraParamsIntensity;
  }
}

void spoilMount(CObservation& observation) {
  if (dynamic_cast<CObservationImage*>(&observation) || dynamic_cast<CObservation3DRangeScan*>(&observation))
    observation.setSensorPose(mrpt::poses::CPose3D(nan, 0, 0));
}

void spoilOdometry(CObservation& observation) {
  if (auto* odometry = dynamic_cast<CObservationOdometry*>(&observation)) odometry->odometry.x(nan);
}

void spoilMovement(CActionCollection& actions) {
  if (const auto movement = actions.getBestMovementEstimation()) movement->rawOdometryIncrementReading.x(nan);
}

const std::map<std::string, std::function<void(CObservation&)>> spoilers = {
    {"no_intrinsics",
     [](CObservation& o) { spoilCamera(o, [](auto&, auto& camera) { camera = mrpt::img::TCamera(); }); }},
    {"nan_intrinsics", [](CObservation& o) { spoilCamera(o, [](auto&, auto& camera) { camera.fx(nan); }); }},
    {"missing_image",
     [](CObservation& o) {
       spoilCamera(o, [](auto& image, auto&) { image.setExternalStorage("missing.jpg"); });
     }},
    {"garbage_image",
     [](CObservation& o) {
       spoilCamera(o, [](auto& image, auto&) { image.setExternalStorage("garbage.jpg"); });
     }},
    {"nan_mount", spoilMount},
    {"nan_odometry", spoilOdometry},
};

bool isCamera(const CObservation::Ptr& observation) {
  return observation->sensorLabel == "camera";
}

void removeCamera(CRawlog& log) {
  for (std::size_t i = log.size(); i-- > 0;) {
    const auto observation = std::dynamic_pointer_cast<CObservation>(log.getAsGeneric(i));
    if (observation && isCamera(observation)) log.remove(i);
  }
}

void spoilLog(CRawlog& log, const std::string& how) {
  const auto& spoil = spoilers.at(how);
  for (std::size_t i = 0; i < log.size(); ++i) {
    const auto entry = log.getAsGeneric(i);
    if (auto observation = std::dynamic_pointer_cast<CObservation>(entry)) spoil(*observation);
    if (auto frame = std::dynamic_pointer_cast<CSensoryFrame>(entry))
      for (const auto& observation : *frame) spoil(*observation);
    auto actions = std::dynamic_pointer_cast<CActionCollection>(entry);
    if (actions && how == "nan_odometry") spoilMovement(*actions);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CRawlog log;
  if (argc != 4 || !spoilers.contains(argv[2]) || !log.loadFromRawLogFile(argv[1])) {
    std::cerr << "usage: spoil_rawlog IN.rawlog HOW OUT.rawlog\n";
    return 2;
  }
  spoilLog(log, argv[2]);
  return log.saveToRawLogFile(argv[3]) ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/camera_observation.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <stdexcept>
#include <tuple>

#include "camera_calibration.h"
#include "grey_image.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

void checkSize(const Image& image, const PinholeCamera& camera) {
  if (image.width == camera.width && image.height == camera.height) return;
  const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
  throw std::runtime_error("the image is " + size(image.width, image.height) + ", its intrinsics are for " +
                           size(camera.width, camera.height));
}

CameraObservation convert(const mrpt::obs::CObservation& observation, const mrpt::img::CImage& image,
                          const mrpt::img::TCamera& camera, const mrpt::poses::CPose3D& robot_from_camera) try {
  CameraObservation out;
  out.label = observation.sensorLabel;
  if (observation.timestamp == INVALID_TIMESTAMP) throw std::runtime_error("no time stamp");
  out.time = mrpt::Clock::toDouble(observation.timestamp);
  out.calibration = calibrationOf(camera);
  out.robot_from_camera = toRigid3(robot_from_camera);
  if (!out.robot_from_camera.matrix().allFinite()) throw std::runtime_error("the camera's pose is not finite");
  out.image = greyImage(image);
  checkSize(out.image, out.calibration.pinhole);
  return out;
} catch (const std::exception& error) {
  throw std::runtime_error("camera '" + observation.sensorLabel + "': " + errorMessage(error));
}

}  // namespace

std::optional<CameraObservation> cameraObservation(const mrpt::obs::CObservation& observation) {
  if (const auto* camera = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation))
    return convert(observation, camera->image, camera->cameraParams, camera->cameraPose);
  if (const auto* depth_camera = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    if (!depth_camera->hasIntensityImage)
      throw std::runtime_error("camera '" + observation.sensorLabel + "': no image");
    return convert(observation, depth_camera->intensityImage, depth_camera->cameraParamsIntensity,
                   depth_camera->sensorPose + depth_camera->relativePoseIntensityWRTDepth);
  }
  if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation))
    return convert(observation, pair->imageLeft, pair->leftCamera, mrpt::poses::CPose3D(pair->cameraPose));
  return std::nullopt;
}

bool holdsCameraImage(const mrpt::obs::CObservation& observation) {
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation))
    return scan->hasIntensityImage;
  return dynamic_cast<const mrpt::obs::CObservationImage*>(&observation) ||
         dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
}

bool sameCalibration(const CameraCalibration& a, const CameraCalibration& b) {
  const auto values = [](const CameraCalibration& of) {
    const PinholeCamera& pinhole = of.pinhole;
    return std::tuple(pinhole.width, pinhole.height, pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy, of.distortion);
  };
  return values(a) == values(b);
}

}  // namespace vmcl

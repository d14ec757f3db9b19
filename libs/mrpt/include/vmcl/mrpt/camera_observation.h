// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/planar_pose.h"
#include "vmcl/vision/image.h"

namespace vmcl {

/// What a camera observation of a log says, without MRPT: a grey image, the camera, its mount and the time.
struct CameraObservation {
  std::string label;  ///< sensor label
  double time = 0;    ///< seconds since the epoch of the log
  Image image;
  CameraCalibration calibration;
  Rigid3 robot_from_camera = Rigid3::Identity();
};

/// Reads a CObservationImage, the intensity image of a CObservation3DRangeScan or the left one of a
/// CObservationStereoImages; nothing for other classes. Throws std::runtime_error naming the sensor label: no image, an
/// image file that cannot be read, no intrinsics, another size than the intrinsics, values that are not finite.
std::optional<CameraObservation> cameraObservation(const mrpt::obs::CObservation& observation);

/// Whether an observation is of a class that cameraObservation() reads, and has an image.
bool holdsCameraImage(const mrpt::obs::CObservation& observation);

/// Whether both are of one camera: the same in all values.
bool sameCalibration(const CameraCalibration& a, const CameraCalibration& b);

}  // namespace vmcl

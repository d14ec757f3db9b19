// SPDX-License-Identifier: BSD-3-Clause
#include "depth_observation.h"

#include "sensor_mount.h"

namespace vmcl {

mrpt::obs::CObservation3DRangeScan depthObservation(const mrpt::obs::CObservationImage& colour,
                                                    const cv::Mat& millimetres) {
  mrpt::obs::CObservation3DRangeScan observation;
  observation.sensorLabel = colour.sensorLabel;
  observation.timestamp = colour.timestamp;
  observation.cameraParams = observation.cameraParamsIntensity = colour.cameraParams;
  // The depth image's frame has the robot's kind of axes, the intensity image's the optical ones.
  observation.sensorPose = colour.cameraPose + (mrpt::poses::CPose3D() - opticalAxes());
  observation.relativePoseIntensityWRTDepth = opticalAxes();
  observation.range_is_depth = true;
  observation.rangeUnits = 0.001f;
  observation.hasRangeImage = true;
  observation.rangeImage_setSize(millimetres.rows, millimetres.cols);
  double farthest = 0;
  cv::minMaxLoc(millimetres, nullptr, &farthest);
  for (int row = 0; row < millimetres.rows; ++row)
    for (int column = 0; column < millimetres.cols; ++column)
      observation.rangeImage(row, column) = millimetres.at<uint16_t>(row, column);
  observation.maxRange = static_cast<float>(farthest / 1000);
  observation.hasIntensityImage = true;
  return observation;
}

}  // namespace vmcl

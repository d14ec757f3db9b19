// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vmcl {

/// Standard deviations of what the images say. Triangulating range cameras and stereo measure a disparity, so that it
/// is the inverse of a depth whose error is the same near and far, and that of the depth grows with its square
/// (Khoshelham and Elberink, "Accuracy and resolution of Kinect depth data", Sensors 2012).
struct MeasurementNoise {
  double pixel = 1;              ///< of a feature, each coordinate
  double inverse_depth = 0.005;  ///< of a measured depth (1/m): that of a depth at 1 m in m
};

}  // namespace vmcl

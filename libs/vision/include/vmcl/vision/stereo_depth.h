// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/planar_pose.h"
#include "vmcl/vision/depth_image.h"
#include "vmcl/vision/image.h"

namespace vmcl {

/// Two cameras that look the same way, the second to the right of the first.
struct StereoPair {
  CameraCalibration left;
  CameraCalibration right;
  Rigid3 left_from_right = Rigid3::Identity();  ///< optical frames; its translation is the baseline (m)

  /// Throws std::invalid_argument: a bad calibration, images of over 16384 pixels a side, a baseline outside of 1 mm to
  /// 10 m, cameras that do not stand side by side or look apart by more than 15 deg.
  void check() const;
};

/// Depth of the left image's pixels from two grey images taken at once, rectified or not: semi-global matching
/// (Hirschmueller, "Stereo processing by semiglobal matching and mutual information", PAMI 2008), 0 where it finds no
/// disparity that is unambiguous and the same from both sides, for what is much nearer than 0.3 m or has a disparity of
/// over 512 pixels, and beyond one pixel of disparity.
/// The standard deviation of a disparity is some 0.3 px, so that of the inverse depth is that over baseline and focal
/// length. Deterministic. Throws std::invalid_argument for a bad pair and images of other sizes than their
/// calibrations.
DepthImage stereoDepth(const StereoPair& pair, const Image& left, const Image& right);

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/relocalization/relocalizer.h"
#include "vmcl/vision/guided_matching.h"

namespace vmcl {

/// What an image should show of the map from about an expected pose. All given must outlive it.
class ExpectedView {
 public:
  ExpectedView(const KeyframeMap& map, const QueryImage& image, const ExpectedPose& expected,
               const RelocalizerOptions& options);

  /// A few whose view is most like it.
  std::vector<int> keyframes() const;

  /// Where the image should show those features of a keyframe whose landmarks are certain enough.
  std::vector<ExpectedFeature> features(const Keyframe& keyframe, const std::vector<bool>& is_certain) const;

  /// Of its pixels; at most 1.
  double shareOfImage(double area_px2) const;

 private:
  const KeyframeMap& map_;
  const PinholeCamera& camera_;
  PlanarPose robot_in_map_;
  Eigen::Matrix3d covariance_;  ///< of the robot's pose
  Rigid3 map_from_camera_;
  double sigma_px_;  ///< of what the pose leaves open: a feature's own noise, and the robot's tilt
};

}  // namespace vmcl

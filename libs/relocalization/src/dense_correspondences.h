// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/relocalization/relocalizer.h"
#include "vmcl/vision/dense_matching.h"

namespace vmcl {

/// Ideal pixels of a query image and of a keyframe that show the same.
struct DenseCorrespondence {
  Eigen::Vector2d query_pixel, reference_pixel;
  int landmark = -1;  ///< that the keyframe shows there; index into KeyframeMap::landmarks, -1: none
};

/// Of points on a grid over the keyframe and, for their depth, of its landmarks; `matcher` looks for them in the query
/// image. Throws std::runtime_error when the keyframe's image is broken.
std::vector<DenseCorrespondence> denseCorrespondences(const DenseMatcher& matcher,
                                                      const CameraCalibration& query_calibration,
                                                      const KeyframeMap& map, const Keyframe& reference);

}  // namespace vmcl

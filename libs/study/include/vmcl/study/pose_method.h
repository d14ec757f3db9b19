// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// What every method of the study is told.
struct MethodSettings {
  double sigma_px = 2;        ///< standard deviation of a pixel coordinate, for methods that ask for it
  double threshold_px = 4;    ///< residual up to which a match counts as an inlier, for methods that ask for it
  int iterations = 500;       ///< most random samples drawn
  double confidence = 0.999;  ///< methods that stop before that do so once they are this sure of an all-inlier sample
  uint64_t seed = 1;          ///< of the methods that can be seeded; the others always draw the same
};

/// A way to find map_from_robot from matches.
struct PoseMethod {
  std::string name;         ///< as in tables
  std::string description;  ///< what it does and which matches it can use
  bool takes_rigs = false;  ///< whether the matches may come from several cameras
  /// The poses found, the best first; none where it finds none. Six-degree-of-freedom poses are cut down to their
  /// planar part. Thread safe.
  std::function<std::vector<PlanarPose>(const PoseProblem&, const MethodSettings&)> estimate;
};

/// All methods, ours first.
std::vector<PoseMethod> poseMethods();

/// Ours, told that the robot may tilt by some 0.5 deg. For worlds with tilt.
PoseMethod softPlaneMethod();

/// Whether OpenGV's methods are among them: the library is optional where vmcl is built.
bool hasOpenGv();

}  // namespace vmcl

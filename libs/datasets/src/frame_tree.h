// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Frames and how they lie to each other.
class FrameTree {
 public:
  void add(const std::string& parent, const std::string& child, const Rigid3& parent_from_child);

  /// a_from_b over any number of frames in between. Throws std::runtime_error naming both if there is no way.
  Rigid3 between(const std::string& a, const std::string& b) const;

 private:
  std::map<std::string, std::map<std::string, Rigid3>> neighbours_;  ///< neighbours_[a][b] is a_from_b
};

}  // namespace vmcl

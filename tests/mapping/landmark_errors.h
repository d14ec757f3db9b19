// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "synthetic_room.h"
#include "vmcl/mapping/keyframe_map.h"

namespace vmcl::testing {

/// Number of the room's point that has this descriptor, for every descriptor.
class PointFinder {
 public:
  explicit PointFinder(const Descriptors& descriptors) {
    for (int i = 0; i < descriptors.rows(); ++i) number_[key(descriptors.row(i))] = i;
  }
  int find(const Descriptors& descriptor) const { return number_.at(key(descriptor)); }

 private:
  static std::string key(const Descriptors& descriptor) {
    return {reinterpret_cast<const char*>(descriptor.data()), 32};
  }
  std::map<std::string, int> number_;
};

/// Of the landmarks of a map of a room, in their order.
struct LandmarkErrors {
  std::vector<Eigen::Vector3d> errors;
  std::vector<double> nees;  // normalized estimation error squared
  int mixed = 0;             // landmarks with observations of more than one point
};

inline LandmarkErrors landmarkErrors(const KeyframeMap& map, const Room& room) {
  const PointFinder finder(room.descriptors);
  std::vector<int> point_of(map.landmarks.size(), -1);
  LandmarkErrors result;
  for (const Keyframe& keyframe : map.keyframes) {
    for (int i = 0; i < keyframe.features.size(); ++i) {
      const int landmark = keyframe.landmark_of_feature[static_cast<std::size_t>(i)];
      if (landmark < 0) continue;
      const int point = finder.find(keyframe.features.descriptors.row(i));
      int& known = point_of[static_cast<std::size_t>(landmark)];
      if (known >= 0 && known != point) ++result.mixed;
      known = point;
    }
  }
  for (std::size_t l = 0; l < map.landmarks.size(); ++l) {
    const Eigen::Vector3d error =
        map.landmarks[l].point_in_map - room.points_in_map[static_cast<std::size_t>(point_of[l])];
    result.errors.push_back(error);
    result.nees.push_back(error.dot(map.landmarks[l].covariance.ldlt().solve(error)));
  }
  return result;
}

}  // namespace vmcl::testing

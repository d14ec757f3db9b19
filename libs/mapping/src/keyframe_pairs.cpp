// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace vmcl {
namespace {

constexpr double typical_distance = 3;  // of the scene indoors (m)

double halfFieldOfView(const PinholeCamera& camera) { return std::atan(camera.width / (2 * camera.fx)); }

}  // namespace

double viewDifference(const Rigid3& map_from_first, const Rigid3& map_from_second) {
  const Eigen::Vector3d first_axis = map_from_first.linear().col(2), second_axis = map_from_second.linear().col(2);
  const double turn = std::atan2(first_axis.cross(second_axis).norm(), first_axis.dot(second_axis));
  const double shift = (map_from_first.translation() - map_from_second.translation()).norm();
  return turn + std::atan(shift / typical_distance);
}

std::vector<std::pair<int, int>> overlappingPairs(const std::vector<ReferenceCamera>& views, int neighbours) {
  std::set<std::pair<int, int>> pairs;
  const int count = static_cast<int>(views.size());
  std::vector<std::pair<double, int>> others;
  for (int i = 0; i < count; ++i) {
    others.clear();
    for (int j = 0; j < count; ++j) {
      if (j == i) continue;
      const double difference = viewDifference(views[i].map_from_camera, views[j].map_from_camera);
      const double overlap_ends = halfFieldOfView(views[i].camera) + halfFieldOfView(views[j].camera);
      if (difference < overlap_ends / 2) others.emplace_back(difference, j);
    }
    const auto kept = std::min<std::ptrdiff_t>(neighbours, std::ssize(others));
    std::partial_sort(others.begin(), others.begin() + kept, others.end());
    for (auto other = others.begin(); other != others.begin() + kept; ++other)
      pairs.insert(std::minmax(i, other->second));
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace vmcl

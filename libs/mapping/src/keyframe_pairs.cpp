// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace vmcl {
namespace {

constexpr double typical_distance = 3;  // of the scene indoors (m)

double halfFieldOfView(const PinholeCamera& camera) { return std::atan(camera.width / (2 * camera.fx)); }

/// Views by square cells of the ground so large that views which overlap lie in cells that touch.
class Cells {
 public:
  explicit Cells(const std::vector<ReferenceCamera>& views) {
    double widest = 0;
    for (const ReferenceCamera& view : views) widest = std::max(widest, halfFieldOfView(view.camera));
    side_ = typical_distance * std::tan(std::min(widest, 1.5));
    for (int i = 0; i < static_cast<int>(views.size()); ++i) views_[cellOf(views[i])].push_back(i);
  }

  /// In the view's cell and those about it.
  std::vector<int> about(const ReferenceCamera& view) const {
    std::vector<int> near;
    const auto [x, y] = cellOf(view);
    for (double column : {x - 1, x, x + 1})
      for (double row : {y - 1, y, y + 1})
        if (const auto cell = views_.find({column, row}); cell != views_.end())
          near.insert(near.end(), cell->second.begin(), cell->second.end());
    return near;
  }

 private:
  using Cell = std::pair<double, double>;  // whole numbers

  Cell cellOf(const ReferenceCamera& view) const {
    const Eigen::Vector3d cell = view.map_from_camera.translation() / side_;
    return {std::round(cell.x()), std::round(cell.y())};
  }

  double side_ = 0;  // m
  std::map<Cell, std::vector<int>> views_;
};

}  // namespace

double viewDifference(const Rigid3& map_from_first, const Rigid3& map_from_second) {
  const Eigen::Vector3d first_axis = map_from_first.linear().col(2), second_axis = map_from_second.linear().col(2);
  const double turn = std::atan2(first_axis.cross(second_axis).norm(), first_axis.dot(second_axis));
  const double shift = (map_from_first.translation() - map_from_second.translation()).norm();
  return turn + std::atan(shift / typical_distance);
}

std::vector<std::pair<int, int>> overlappingPairs(const std::vector<ReferenceCamera>& views, int neighbours) {
  std::set<std::pair<int, int>> pairs;
  const Cells cells(views);
  std::vector<std::pair<double, int>> others;
  for (int i = 0; i < static_cast<int>(views.size()); ++i) {
    others.clear();
    for (int j : cells.about(views[i])) {
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

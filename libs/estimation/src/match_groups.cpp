// SPDX-License-Identifier: BSD-3-Clause
#include "match_groups.h"

#include <map>
#include <utility>

namespace vmcl {

MatchGroups::MatchGroups(const PoseProblem& problem)
    : query_cameras(problem.query_cameras),
      reference_cameras(problem.reference_cameras),
      match_count(static_cast<int>(problem.matches.size())) {
  std::map<int, PointGroup> points_of;
  std::map<std::pair<int, int>, RayGroup> rays_of;
  for (int i = 0; i < match_count; ++i) {
    const Match& match = problem.matches[static_cast<std::size_t>(i)];
    if (match.point) {
      PointGroup& group = points_of[match.query_camera];
      group.query = match.query_camera;
      group.match.push_back(i);
      group.pixel.push_back(match.query_pixel);
      group.point_in_map.push_back(match.point->point_in_map);
      group.covariance.push_back(match.point->covariance);
      group.worth.push_back(1);
    } else {
      RayGroup& group = rays_of[{match.query_camera, match.reference_camera}];
      group.query = match.query_camera;
      group.reference = match.reference_camera;
      group.match.push_back(i);
      group.query_pixel.push_back(match.query_pixel);
      group.reference_pixel.push_back(match.reference_pixel);
      group.worth.push_back(1);
    }
  }
  for (auto& [key, group] : points_of) points.push_back(std::move(group));
  for (auto& [key, group] : rays_of) rays.push_back(std::move(group));
}

void MatchGroups::setWorth(const std::vector<double>& worth) {
  const auto set = [&](auto& groups) {
    for (auto& group : groups) {
      group.worth.clear();
      for (const int match : group.match) group.worth.push_back(worth[static_cast<std::size_t>(match)]);
    }
  };
  set(points);
  set(rays);
}

}  // namespace vmcl

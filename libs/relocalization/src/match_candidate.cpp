// SPDX-License-Identifier: BSD-3-Clause
#include "match_candidate.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "vmcl/vision/dense_matching.h"

namespace vmcl {
namespace {

/// Dense matches nearer to each other than this share most of the windows that they were found by, and their errors.
constexpr double independent_px = 3 * dense_grid_step;

}  // namespace

std::vector<MatchCandidate> withoutRepetition(std::vector<MatchCandidate> candidates) {
  std::ranges::stable_sort(candidates, {}, [](const MatchCandidate& candidate) {
    return std::tuple(candidate.is_dense, !candidate.match.point, candidate.ratio);
  });
  std::set<int> used_landmarks;
  std::set<std::pair<double, double>> used_places;
  std::set<std::pair<int, int>> cells, cells_with_depth;
  std::erase_if(candidates, [&](const MatchCandidate& candidate) {
    const Eigen::Vector2d& pixel = candidate.match.query_pixel;
    const Eigen::Vector2i cell = (pixel / independent_px).array().floor().cast<int>();
    const std::pair place(pixel.x(), pixel.y());
    const std::pair cell_place(cell.x(), cell.y());
    if (candidate.is_dense ? (candidate.match.point ? cells_with_depth : cells).contains(cell_place)
                           : used_places.contains(place))
      return true;
    if (candidate.landmark >= 0 && !used_landmarks.insert(candidate.landmark).second) return true;
    used_places.insert(place);
    cells.insert(cell_place);
    if (candidate.match.point) cells_with_depth.insert(cell_place);
    return false;
  });
  return candidates;
}

}  // namespace vmcl

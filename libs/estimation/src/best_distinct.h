// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vmcl {

/// Indices of at most `keep` of the things with these scores, the best first, without each that is
/// alike(one, better_one) to one kept before. Knows nothing of geometry.
template <class Alike>
std::vector<std::size_t> bestDistinct(const std::vector<double>& scores, std::size_t keep, Alike&& alike) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  std::vector<std::size_t> best;
  for (const std::size_t i : order) {
    if (best.size() >= keep) break;
    if (std::ranges::none_of(best, [&](std::size_t better) { return alike(i, better); })) best.push_back(i);
  }
  return best;
}

}  // namespace vmcl

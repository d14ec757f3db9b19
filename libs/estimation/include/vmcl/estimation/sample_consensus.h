// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace vmcl {

template <class Hypothesis>
struct ScoredHypothesis {
  Hypothesis hypothesis;
  double score = 0;
};

/// The hypotheses to look at closer: scores them all in one call, score(hypotheses, scores), and keeps the best `keep`,
/// highest first, leaving out each that is alike(one, better_one) to one kept before. Knows nothing of geometry.
template <class Hypothesis, class Score, class Alike>
std::vector<ScoredHypothesis<Hypothesis>> bestHypotheses(const std::vector<Hypothesis>& hypotheses, int keep,
                                                         Score&& score, Alike&& alike) {
  std::vector<double> scores(hypotheses.size());
  score(std::span<const Hypothesis>(hypotheses), std::span<double>(scores));
  std::vector<std::size_t> order(hypotheses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  std::vector<ScoredHypothesis<Hypothesis>> best;
  for (std::size_t i : order) {
    if (static_cast<int>(best.size()) >= keep) break;
    const bool seen = std::any_of(best.begin(), best.end(), [&](const ScoredHypothesis<Hypothesis>& better) {
      return alike(hypotheses[i], better.hypothesis);
    });
    if (!seen) best.push_back({hypotheses[i], scores[i]});
  }
  return best;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "place_ranking.h"

#include <algorithm>

#include "inlier_odds.h"

namespace vmcl {
namespace {

constexpr int ranking_features = 300;

/// The first of these, which are the strongest.
FeatureSet strongest(const FeatureSet& features, int count) {
  if (features.size() <= count) return features;
  return {features.kind,
          {features.pixels.begin(), features.pixels.begin() + count},
          {features.sizes.begin(), features.sizes.begin() + count},
          {features.responses.begin(), features.responses.begin() + count},
          features.descriptors.topRows(count)};
}

double expectedInliers(const FeatureSet& query, const FeatureSet& reference, const RelocalizerOptions& options) {
  const double prior = options.estimator.likelihood.inlier_prior;
  double expected = 0;
  for (const FeatureMatch& match : matchFeatures(query, reference, options.matching)) {
    const double odds = prior / (1 - prior) * inlierOdds(match.ratio, query.kind);
    expected += odds / (1 + odds);
  }
  return expected;
}

}  // namespace

std::vector<int> bestMatched(std::span<const RetrievedPlace> places, const FeatureSet& query, const KeyframeMap& map,
                             const RelocalizerOptions& options) {
  const auto kept = std::min(places.size(), static_cast<std::size_t>(options.retrieved));
  std::vector<int> keyframes;
  if (kept == places.size()) {
    for (const RetrievedPlace& place : places) keyframes.push_back(place.index);
    return keyframes;
  }
  const FeatureSet sample = strongest(query, ranking_features);
  std::vector<std::pair<double, int>> ranked;
  for (const RetrievedPlace& place : places)
    ranked.emplace_back(expectedInliers(sample, map.keyframes[static_cast<std::size_t>(place.index)].features, options),
                        place.index);
  std::ranges::stable_sort(ranked, std::greater(), &std::pair<double, int>::first);
  for (std::size_t i = 0; i < kept; ++i) keyframes.push_back(ranked[i].second);
  return keyframes;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/feature_matching.h"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "nearest_descriptors.h"

namespace vmcl {
namespace {

float ratioOf(const Nearest& nearest, FeatureKind kind) {
  if (nearest.second_distance == 0 || nearest.second_distance == no_distance) return 1;
  const float ratio = static_cast<float>(nearest.distance) / static_cast<float>(nearest.second_distance);
  return isBinary(kind) ? ratio : std::sqrt(ratio);
}

}  // namespace

void MatchingOptions::check() const {
  if (!(max_ratio > 0 && max_ratio <= 1))
    throw std::invalid_argument("max_ratio is " + std::to_string(max_ratio) + ", not in (0, 1]");
}

std::vector<FeatureMatch> matchFeatures(const FeatureSet& query, const FeatureSet& reference,
                                        const MatchingOptions& options) {
  options.check();
  if (query.kind != reference.kind) throw std::invalid_argument("features of different kinds cannot be matched");
  std::vector<FeatureMatch> matches;
  if (query.size() == 0 || reference.size() == 0) return matches;
  if (query.descriptors.cols() != reference.descriptors.cols())
    throw std::invalid_argument("descriptors of " + std::to_string(query.descriptors.cols()) + " and " +
                                std::to_string(reference.descriptors.cols()) + " bytes cannot be matched");

  std::vector<int> rows(static_cast<std::size_t>(query.size()));
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<Nearest> forward =
      nearestAmong(DescriptorBlocks(reference.kind, reference.descriptors), query.descriptors, rows);
  std::vector<int> references;
  for (int i : rows) {
    const Nearest& nearest = forward[static_cast<std::size_t>(i)];
    const float ratio = ratioOf(nearest, query.kind);
    if (ratio > options.max_ratio) continue;
    matches.push_back({i, nearest.row, ratio});
    references.push_back(nearest.row);
  }
  const std::vector<Nearest> back =
      nearestAmong(DescriptorBlocks(query.kind, query.descriptors), reference.descriptors, references);
  std::vector<FeatureMatch> mutual;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (back[i].row == matches[i].query) mutual.push_back(matches[i]);
  return mutual;
}

}  // namespace vmcl

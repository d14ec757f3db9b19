// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/vision/features.h"

namespace vmcl {

struct MatchingOptions {
  double max_ratio = 0.8;  ///< distance to the nearest over distance to the second nearest (Lowe 2004), in (0, 1]

  void check() const;
};

/// Row numbers of a pair of features taken for the same scene point.
struct FeatureMatch {
  int query = 0;
  int reference = 0;
  float ratio = 1;          ///< of the ratio test; smaller is more distinctive
  double searched_px2 = 0;  ///< area of the query image that the query feature was sought in; 0: all of it
};

/// Pairs each of which is the other's nearest, by increasing query row. Memory is linear in the number of features.
/// Throws std::invalid_argument when the kinds differ.
std::vector<FeatureMatch> matchFeatures(const FeatureSet& query, const FeatureSet& reference,
                                        const MatchingOptions& options);

}  // namespace vmcl

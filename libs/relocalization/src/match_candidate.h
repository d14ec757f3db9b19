// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// A match of one query image before evidence that repeats itself is dropped.
struct MatchCandidate {
  Match match;
  bool is_dense = false;
  float ratio = 1;      ///< of the ratio test
  int landmark = -1;    ///< index into KeyframeMap::landmarks, -1: none
  double searched = 1;  ///< share of the query image that the match was sought in
};

/// Each place of the query image was measured once and gives one match, with depth if there is such a one, by the most
/// distinctive feature: matches with several references, and features that differ in orientation alone, share its
/// error. So does a landmark, seen through whatever reference. Dense matches fill what is left of the image, one a
/// cell, and bring depth to cells without.
std::vector<MatchCandidate> withoutRepetition(std::vector<MatchCandidate> candidates);

}  // namespace vmcl

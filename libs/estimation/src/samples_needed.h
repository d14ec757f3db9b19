// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace vmcl {

/// RANSAC's rule: so many samples that one without outliers is among them but for once in 1000 times, if each is with
/// this chance; infinite for none.
inline double samplesNeeded(double chance_of_inliers) {
  constexpr double miss = 1e-3;
  return std::ceil(std::log(miss) / std::log1p(-std::min(chance_of_inliers, 1 - miss)));
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "vmcl/geometry/random.h"

namespace vmcl {

/// Numbers from 0 on, drawn in proportion to their weights.
class WeightedChoice {
 public:
  void add(double weight) { sums_.push_back((sums_.empty() ? 0 : sums_.back()) + weight); }

  std::size_t draw(Random& random) const {
    const auto drawn = std::upper_bound(sums_.begin(), sums_.end() - 1, random.uniform() * sums_.back());
    return static_cast<std::size_t>(drawn - sums_.begin());
  }

  /// Chance that it is drawn.
  double share(std::size_t number) const {
    return (sums_[number] - (number == 0 ? 0 : sums_[number - 1])) / sums_.back();
  }

 private:
  std::vector<double> sums_;
};

}  // namespace vmcl

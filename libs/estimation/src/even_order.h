// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include "vmcl/geometry/random.h"

namespace vmcl {

/// The numbers below a bound of at most 2^53, each once before any comes again, and spread evenly from the first on: a
/// Weyl sequence of the golden ratio with a random start.
class EvenOrder {
 public:
  EvenOrder(uint64_t bound, Random& random)
      : bound_(bound), stride_(strideOf(bound)), next_(static_cast<uint64_t>(random.uniform(0, double(bound)))) {}

  uint64_t next() {
    const uint64_t number = next_;
    next_ = number >= bound_ - stride_ ? number - (bound_ - stride_) : number + stride_;
    return number;
  }

 private:
  /// Without a common divisor with the bound.
  static uint64_t strideOf(uint64_t bound) {
    auto stride = static_cast<uint64_t>(static_cast<double>(bound) / std::numbers::phi);
    while (std::gcd(stride, bound) > 1) ++stride;
    return stride;
  }

  uint64_t bound_, stride_, next_;
};

}  // namespace vmcl

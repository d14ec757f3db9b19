// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace vmcl {

/// Random numbers whose integers are the same on every platform (the distributions of <random> are not): PCG-XSH-RR
/// 64/32, O'Neill 2014. Passed explicitly, never global. Different streams of one seed are different sequences.
class Random {
 public:
  explicit Random(uint64_t seed, uint64_t stream = 0) : increment_((stream << 1) | 1) {
    next();
    state_ += seed;
    next();
  }

  /// 32 random bits.
  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<uint32_t>(old >> 59);
    return (shifted >> turn) | (shifted << ((32 - turn) & 31));
  }

  /// Uniform integer in [0, bound), bound > 0 (Lemire 2019, bias below bound / 2^32).
  uint32_t below(uint32_t bound) { return static_cast<uint32_t>((uint64_t{next()} * bound) >> 32); }

  /// Uniform in [0, 1) with 53 bits.
  double uniform() {
    const uint64_t bits = (uint64_t{next()} << 32 | next()) >> 11;
    return static_cast<double>(bits) * 0x1p-53;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal (Box-Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  uint64_t state_ = 0;
  uint64_t increment_;
};

}  // namespace vmcl

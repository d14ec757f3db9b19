// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/random.h"

#include <gtest/gtest.h>

#include <array>

namespace vmcl {
namespace {

// The first outputs of pcg32 seeded with (42, 54), as in the demo of its authors.
TEST(Random, IsPcg32) {
  Random random(42, 54);
  for (const uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, StreamsAndSeedsDiffer) {
  EXPECT_NE(Random(1).next(), Random(2).next());
  EXPECT_NE(Random(1, 0).next(), Random(1, 1).next());
}

// Chi-squared with 9 degrees of freedom: over 33.7 once in 10,000. Seed 3.
TEST(Random, BelowIsUniform) {
  Random random(3);
  std::array<int, 10> counts{};
  for (int i = 0; i < 10000; ++i) ++counts.at(random.below(10));
  double chi2 = 0;
  for (int count : counts) chi2 += (count - 1000.0) * (count - 1000.0) / 1000;
  EXPECT_LT(chi2, 33.7);
}

// Standard errors of mean and variance over 100,000 draws: 0.0032 and 0.0045; five of each. Seed 4.
TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random random(4);
  double sum = 0, sum2 = 0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    sum2 += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.016);
  EXPECT_NEAR(sum2 / n, 1, 0.023);
}

TEST(Random, UniformStaysInRange) {
  Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform(-2, 3);
    EXPECT_GE(x, -2);
    EXPECT_LT(x, 3);
  }
}

}  // namespace
}  // namespace vmcl

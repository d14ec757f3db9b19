// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/confidence_interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

TEST(WilsonInterval, KnownValues) {
  // Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  EXPECT_NEAR(wilsonInterval(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilsonInterval(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilsonInterval(15, 148).low, 0.0624, 5e-5);
  EXPECT_NEAR(wilsonInterval(15, 148).high, 0.1605, 5e-5);
  EXPECT_EQ(wilsonInterval(0, 20).low, 0);
  EXPECT_NEAR(wilsonInterval(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilsonInterval(1, 29).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilsonInterval(1, 29).high, 0.1718, 5e-5);
  EXPECT_EQ(wilsonInterval(20, 20).high, 1);
}

TEST(WilsonInterval, RefusesWhatIsNoRate) {
  EXPECT_THROW(wilsonInterval(0, 0), std::invalid_argument);
  EXPECT_THROW(wilsonInterval(3, 2), std::invalid_argument);
  EXPECT_THROW(wilsonInterval(-1, 2), std::invalid_argument);
}

TEST(RootMean, OfSquares) {
  EXPECT_DOUBLE_EQ(rootMean(std::array{9.0, 16.0, 11.0}), std::sqrt(12));
  EXPECT_EQ(rootMean({}), 0);
  EXPECT_EQ(bootstrapRootMean({}).high, 0);
  const Interval same = bootstrapRootMean(std::array{4.0, 4.0, 4.0});
  EXPECT_DOUBLE_EQ(same.low, 2);
  EXPECT_DOUBLE_EQ(same.high, 2);
}

TEST(Median, OfOddAndEvenNumbers) {
  EXPECT_EQ(median(std::array{3.0, 1.0, 2.0}), 2);
  EXPECT_EQ(median(std::array{4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(mean(std::array{1.0, 2.0, 6.0}), 3);
}

// Of three values the median of a sample is the least with chance 7/27, as is the greatest: both ends of the interval.
TEST(BootstrapMedian, OfThreeValues) {
  const Interval interval = bootstrapMedian(std::array{1.0, 2.0, 3.0});
  EXPECT_EQ(interval.low, 1);
  EXPECT_EQ(interval.high, 3);
}

// The mean of ten samples of 0 or 1 is 0.1 or less with chance 1.1 %, 0.2 or less with 5.5 %.
TEST(BootstrapMean, OfTenValues) {
  const Interval interval = bootstrapMean(std::array{0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(interval.low, 0.2);
  EXPECT_DOUBLE_EQ(interval.high, 0.8);
}

/// Of 400 intervals, those that miss the true value are binomial; a correct 95 % interval of so many normal errors
/// misses it in 5 to 6 %, so that over 40 misses (10 %) happen by chance in fewer than 1 of 1000 seeds.
TEST(BootstrapRootMean, HoldsTheTrueValueNineteenTimesOfTwenty) {
  Random random(7);
  int misses = 0;
  for (int run = 0; run < 400; ++run) {
    std::vector<double> squares(100);
    for (double& square : squares) square = 9 * std::pow(random.normal(), 2);
    const Interval interval = bootstrapRootMean(squares);
    misses += interval.low > 3 || interval.high < 3;
  }
  EXPECT_GE(misses, 5);
  EXPECT_LE(misses, 40);
}

}  // namespace
}  // namespace vmcl

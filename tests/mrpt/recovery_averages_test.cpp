// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/recovery_averages.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

TEST(RecoveryAverages, AgreesWithTheTextbookByHand) {
  RecoveryAverages averages(0.1, 0.5);
  averages.add(std::log(4.0));  // w_slow = w_fast = 4
  EXPECT_EQ(averages.randomShare(), 0);
  averages.add(std::log(2.0));  // w_slow = 4 + 0.1 (2 - 4) = 3.8, w_fast = 4 + 0.5 (2 - 4) = 3
  EXPECT_NEAR(averages.randomShare(), 1 - 3 / 3.8, 1e-12);
  averages.add(std::log(1.0));  // w_slow = 3.8 - 0.28 = 3.52, w_fast = 2
  EXPECT_NEAR(averages.randomShare(), 1 - 2 / 3.52, 1e-12);
  averages.add(std::log(9.0));  // w_slow = 4.068, w_fast = 5.5: better than before, no random particles
  EXPECT_EQ(averages.randomShare(), 0);
}

TEST(RecoveryAverages, IsExactWhereLikelihoodsUnderflow) {
  RecoveryAverages averages(0.1, 0.5), tiny(0.1, 0.5);
  for (const double likelihood : {4.0, 2.0, 1.0}) {
    averages.add(std::log(likelihood));
    tiny.add(std::log(likelihood) - 5000);
  }
  EXPECT_NEAR(tiny.randomShare(), averages.randomShare(), 1e-9);
}

TEST(RecoveryAverages, IsOffUnlessBothRatesArePositive) {
  const auto share = [](double alpha_slow, double alpha_fast) {
    RecoveryAverages averages(alpha_slow, alpha_fast);
    averages.add(0);
    averages.add(-3);
    return averages.randomShare();
  };
  EXPECT_EQ(share(0, 0), 0);
  EXPECT_EQ(share(0, 0.1), 0);
  EXPECT_EQ(share(0.001, 0), 0);
  EXPECT_GT(share(0.001, 0.1), 0);
}

TEST(RecoveryAverages, RefusesBadRates) {
  EXPECT_THROW(RecoveryAverages(-0.1, 0.1), std::invalid_argument);
  EXPECT_THROW(RecoveryAverages(0.1, 1.5), std::invalid_argument);
  EXPECT_THROW(RecoveryAverages(std::nan(""), 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/kld_sample_size.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

mrpt::slam::TKLDParams kldOptions() {
  mrpt::slam::TKLDParams kld;
  kld.KLD_minSampleSize = 10;
  kld.KLD_maxSampleSize = 100000;
  kld.KLD_epsilon = 0.05;
  kld.KLD_delta = 0.01;
  kld.KLD_binSize_XY = 0.5;
  kld.KLD_binSize_PHI = 10 * degree;
  return kld;
}

/// chi-square quantile / (2 epsilon), with quantiles from tables: the probability is one, not a normal quantile.
TEST(KldSampleSize, AgreesWithChiSquareTables) {
  const KldSampleSize certain(kldOptions());
  EXPECT_NEAR(static_cast<double>(certain.needed(11)), 23.209 / 0.1, 3);   // 10 degrees of freedom, 0.99
  EXPECT_NEAR(static_cast<double>(certain.needed(101)), 135.81 / 0.1, 3);  // 100
  auto likely = kldOptions();
  likely.KLD_delta = 0.05;
  EXPECT_NEAR(static_cast<double>(KldSampleSize(likely).needed(51)), 67.505 / 0.1, 3);  // 50, 0.95
}

TEST(KldSampleSize, StaysBetweenItsLimits) {
  auto narrow = kldOptions();
  narrow.KLD_minSampleSize = 300;
  narrow.KLD_maxSampleSize = 1000;
  const KldSampleSize size(narrow);
  EXPECT_EQ(size.needed(0), 300U);
  EXPECT_EQ(size.needed(2), 300U);
  EXPECT_EQ(size.needed(1'000'000), 1000U);
}

TEST(KldSampleSize, CountsEachBinOnce) {
  KldSampleSize size(kldOptions());
  EXPECT_EQ(size.add({0.1, 0.1, 0}), 10U);
  EXPECT_EQ(size.add({0.2, -0.1, 0.01}), 10U);
  EXPECT_EQ(size.add({0.1, 0.1, 2 * std::numbers::pi}), 10U);
  EXPECT_EQ(size.add({5, 0.1, 0}), size.needed(2));
  EXPECT_EQ(size.add({1e300, -1e300, 0}), size.needed(3));
}

TEST(KldSampleSize, RefusesBadOptions) {
  const auto refuses = [](auto&& change) {
    auto kld = kldOptions();
    change(kld);
    EXPECT_THROW(KldSampleSize{kld}, std::invalid_argument);
  };
  refuses([](auto& kld) { kld.KLD_minSampleSize = 0; });
  refuses([](auto& kld) { kld.KLD_maxSampleSize = 5; });
  refuses([](auto& kld) { kld.KLD_epsilon = 0; });
  refuses([](auto& kld) { kld.KLD_delta = 1; });
  refuses([](auto& kld) { kld.KLD_binSize_XY = std::nan(""); });
  refuses([](auto& kld) { kld.KLD_binSize_PHI = 0; });
}

}  // namespace
}  // namespace vmcl

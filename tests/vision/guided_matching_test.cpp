// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/guided_matching.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "synthetic_texture.h"

namespace vmcl {
namespace {

class MatchExpected : public testing::TestWithParam<FeatureKind> {
 protected:
  /// 50 features a line of 12 pixels, then the same again 300 pixels below: each has a twin.
  FeatureSet twins() {
    FeatureSet once = randomFeatures(GetParam(), 50, random_), twice = once;
    twice.descriptors.resize(100, once.descriptors.cols());
    twice.descriptors << once.descriptors, once.descriptors;
    twice.pixels.resize(100);
    for (int i = 0; i < 100; ++i)
      twice.pixels[static_cast<std::size_t>(i)] = {12.0f * static_cast<float>(i % 50), i < 50 ? 100.0f : 400.0f};
    twice.sizes.resize(100, 1);
    twice.responses.resize(100, 1);
    return twice;
  }

  static std::vector<ExpectedFeature> near(const FeatureSet& query, const Eigen::Vector2d& offset, double sigma_px) {
    std::vector<ExpectedFeature> expected;
    for (int i = 0; i < query.size() / 2; ++i)
      expected.push_back({i, query.pixels[static_cast<std::size_t>(i)].cast<double>() + offset,
                          sigma_px * sigma_px * Eigen::Matrix2d::Identity()});
    return expected;
  }

  Random random_{3};
};

TEST_P(MatchExpected, TellsTwinsApart) {
  const FeatureSet query = twins();
  EXPECT_TRUE(matchFeatures(query, query, {}).empty());
  const auto matches = matchExpected(query, query, near(query, {7, 305}, 4), {});
  ASSERT_EQ(matches.size(), 50u);
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(match.query, match.reference + 50);
    EXPECT_LT(match.ratio, 0.1f);
    EXPECT_NEAR(match.searched_px2, std::numbers::pi * 11.83 * 16, 0.01);
  }
}

TEST_P(MatchExpected, FindsNothingElsewhere) {
  const FeatureSet query = twins();
  EXPECT_TRUE(matchExpected(query, query, near(query, {0, 150}, 20), {}).empty());
  EXPECT_TRUE(matchExpected(query, query, near(query, {0, 15}, 4), {}).empty());  // beyond 3.44 sigma
  EXPECT_EQ(matchExpected(query, query, near(query, {0, 13}, 4), {}).size(), 50u);
  EXPECT_TRUE(matchExpected(query, query, near(query, {0, 0}, 1e9), {}).empty());  // either twin
  EXPECT_TRUE(matchExpected(query, query, near(query, {1e9, -1e9}, 4), {}).empty());
}

TEST_P(MatchExpected, KeepsTheNearestOfThoseThatNameTheSame) {
  const FeatureSet query = twins();
  FeatureSet reference = query;
  reference.descriptors(0, 0) ^= 1;
  const std::vector<ExpectedFeature> expected{{0, {0, 100}}, {50, {0, 100}}};
  const auto matches = matchExpected(query, reference, expected, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].reference, 50);
}

TEST_P(MatchExpected, RefusesWhatCannotBeExpected) {
  const FeatureSet query = twins();
  const auto refuses = [&](const ExpectedFeature& bad) {
    EXPECT_THROW(matchExpected(query, query, {{bad}}, {}), std::invalid_argument);
  };
  refuses({-1, {0, 100}});
  refuses({100, {0, 100}});
  refuses({0, {std::numeric_limits<double>::quiet_NaN(), 100}});
  refuses({0, {0, 100}, Eigen::Matrix2d::Zero()});
  refuses({0, {0, 100}, Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN())});
  const FeatureSet akaze = randomFeatures(FeatureKind::akaze, 5, random_);
  EXPECT_THROW(matchExpected(query, akaze, {}, {}), std::invalid_argument);
  EXPECT_THROW(matchExpected(query, query, {}, {.max_ratio = 2}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MatchExpected, testing::Values(FeatureKind::orb, FeatureKind::sift));

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/feature_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <map>

#include "synthetic_texture.h"

namespace vmcl {
namespace {

class MatchFeatures : public testing::TestWithParam<FeatureKind> {
 protected:
  Random random_{11};

  double distance(const FeatureSet& a, int i, const FeatureSet& b, int j) const {
    double sum = 0;
    for (Eigen::Index k = 0; k < a.descriptors.cols(); ++k) {
      const int x = a.descriptors(i, k), y = b.descriptors(j, k);
      sum += GetParam() == FeatureKind::orb ? std::popcount(static_cast<unsigned>(x ^ y)) : (x - y) * (x - y);
    }
    return GetParam() == FeatureKind::orb ? sum : std::sqrt(sum);
  }

  /// The set with rows in another order and a few descriptor bytes changed.
  FeatureSet disturbed(const FeatureSet& set, const std::vector<int>& order) {
    FeatureSet result = set;
    for (std::size_t i = 0; i < order.size(); ++i) {
      result.descriptors.row(static_cast<Eigen::Index>(i)) = set.descriptors.row(order[i]);
      for (int k = 0; k < 3; ++k)
        result.descriptors(static_cast<Eigen::Index>(i), random_.below(static_cast<uint32_t>(set.descriptors.cols()))) =
            static_cast<uint8_t>(random_.below(256));
    }
    return result;
  }
};

// A copy is off by at most 24 of 256 bits, or 442 in Euclidean distance; strangers by 128 +- 8, or 1180 +- 60. That one
// of 60 x 60 comes within 1 / 0.8 of a copy is a chance below 1e-8, whatever the seed.
TEST_P(MatchFeatures, FindsDisturbedCopies) {
  const FeatureSet query = randomFeatures(GetParam(), 60, random_);
  std::vector<int> order(60);
  for (int i = 0; i < 60; ++i) order[static_cast<std::size_t>(i)] = (i * 7 + 3) % 60;
  const auto matches = matchFeatures(query, disturbed(query, order), {});
  ASSERT_EQ(matches.size(), 60u);
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(order[static_cast<std::size_t>(match.reference)], match.query);
    EXPECT_LT(match.ratio, 0.8f);
  }
}

TEST_P(MatchFeatures, AgreesWithBruteForce) {
  const FeatureSet query = randomFeatures(GetParam(), 40, random_), reference = randomFeatures(GetParam(), 50, random_);
  const MatchingOptions options{.max_ratio = 0.97};
  std::map<int, std::pair<int, double>> expected;
  for (int i = 0; i < query.size(); ++i) {
    std::vector<std::pair<double, int>> sorted;
    for (int j = 0; j < reference.size(); ++j) sorted.emplace_back(distance(query, i, reference, j), j);
    std::sort(sorted.begin(), sorted.end());
    const auto [nearest, j] = sorted[0];
    int back = 0;
    for (int k = 1; k < query.size(); ++k)
      if (distance(query, k, reference, j) < distance(query, back, reference, j)) back = k;
    if (back == i && nearest <= options.max_ratio * sorted[1].first) expected[i] = {j, nearest / sorted[1].first};
  }
  const auto matches = matchFeatures(query, reference, options);
  ASSERT_GE(matches.size(), 5u);
  ASSERT_EQ(matches.size(), expected.size());
  for (const FeatureMatch& match : matches) {
    ASSERT_TRUE(expected.contains(match.query));
    EXPECT_EQ(match.reference, expected[match.query].first);
    EXPECT_NEAR(match.ratio, expected[match.query].second, 1e-5);
  }
}

TEST_P(MatchFeatures, MutualMatchesAreOneToOneAndSymmetric) {
  const FeatureSet a = randomFeatures(GetParam(), 80, random_), b = randomFeatures(GetParam(), 70, random_);
  const MatchingOptions options{.max_ratio = 1};
  std::map<int, int> forward, backward;
  for (const FeatureMatch& match : matchFeatures(a, b, options)) forward[match.query] = match.reference;
  for (const FeatureMatch& match : matchFeatures(b, a, options)) backward[match.reference] = match.query;
  EXPECT_GT(forward.size(), 10u);
  if (GetParam() == FeatureKind::sift) {  // Hamming distances tie
    EXPECT_EQ(forward, backward);
  }
  std::map<int, int> owners;
  for (auto [query, reference] : forward) EXPECT_EQ(owners[reference]++, 0);
}

TEST_P(MatchFeatures, AmbiguousFeaturesAreDropped) {
  const FeatureSet query = randomFeatures(GetParam(), 1, random_);
  FeatureSet twins = randomFeatures(GetParam(), 5, random_);
  twins.descriptors.row(1) = twins.descriptors.row(3) = query.descriptors.row(0);
  EXPECT_TRUE(matchFeatures(query, twins, {}).empty());
}

TEST_P(MatchFeatures, NothingToMatchGivesNothing) {
  const FeatureSet none = randomFeatures(GetParam(), 0, random_), some = randomFeatures(GetParam(), 5, random_);
  EXPECT_TRUE(matchFeatures(none, some, {}).empty());
  EXPECT_TRUE(matchFeatures(some, none, {}).empty());
  EXPECT_TRUE(matchFeatures(none, none, {}).empty());
}

TEST_P(MatchFeatures, FollowsAShiftedImage) {
  const CameraCalibration camera = centredCamera(320, 240);
  const FeatureExtractor extractor({.kind = GetParam()});
  const Image image = rectangleTexture(320, 240, 21);
  const FeatureSet before = extractor.extract(image.view(), camera);
  const FeatureSet after = extractor.extract(shifted(image, 11, -6).view(), camera);
  const auto matches = matchFeatures(before, after, {});
  int right = 0;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2f moved =
        after.pixels[static_cast<std::size_t>(match.reference)] - before.pixels[static_cast<std::size_t>(match.query)];
    right += (moved - Eigen::Vector2f(11, -6)).norm() < 2;
  }
  EXPECT_GT(right, 100);
  EXPECT_GT(right, 0.9 * static_cast<double>(matches.size()));
}

// A table of all distances would take 320 MB.
TEST(MatchFeaturesTest, MemoryIsLinearInTheFeatures) {
  Random random(1);
  const FeatureSet many = randomFeatures(FeatureKind::orb, 20'000, random);
  const FeatureSet few = randomFeatures(FeatureKind::orb, 4'000, random);
  const auto peakMegabytes = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  };
  const auto before = peakMegabytes();
  matchFeatures(many, few, {});
  EXPECT_LT(peakMegabytes() - before, 50);
}

TEST(MatchingOptionsTest, RefusesWhatMakesNoSense) {
  Random random(1);
  const FeatureSet orb = randomFeatures(FeatureKind::orb, 3, random),
                   sift = randomFeatures(FeatureKind::sift, 3, random);
  EXPECT_THROW(matchFeatures(orb, sift, {}), std::invalid_argument);
  for (double ratio : {0.0, -1.0, 1.01, std::nan("")})
    EXPECT_THAT([&] { matchFeatures(orb, orb, {.max_ratio = ratio}); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("max_ratio")));
}

INSTANTIATE_TEST_SUITE_P(Kinds, MatchFeatures, testing::Values(FeatureKind::orb, FeatureKind::sift),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

}  // namespace
}  // namespace vmcl

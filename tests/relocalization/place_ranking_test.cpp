// SPDX-License-Identifier: BSD-3-Clause
#include "place_ranking.h"

#include <gtest/gtest.h>

#include "vision/synthetic_texture.h"

namespace vmcl {
namespace {

/// Keyframes of 200 random features, the first `shared[i]` of which keyframe i has in common with the query.
class PlaceRankingTest : public testing::Test {
 protected:
  explicit PlaceRankingTest(const std::vector<int>& shared = {10, 40, 0, 90, 40}) {
    for (const int count : shared) {
      Keyframe keyframe;
      keyframe.features = randomFeatures(FeatureKind::orb, 200, random_);
      keyframe.features.descriptors.topRows(count) = query_.descriptors.topRows(count);
      places_.push_back({static_cast<int>(map_.keyframes.size()), 1.0f - 0.1f * static_cast<float>(places_.size())});
      map_.keyframes.push_back(std::move(keyframe));
    }
  }

  std::vector<int> best(int retrieved) const { return bestMatched(places_, query_, map_, {.retrieved = retrieved}); }

  Random random_{5};
  FeatureSet query_ = randomFeatures(FeatureKind::orb, 200, random_);
  KeyframeMap map_;
  std::vector<RetrievedPlace> places_;
};

// Random descriptors match where one is within 84 of 256 bits of another, the second nearest being some 105 bits off:
// a chance of 3e-8 a pair, and of 1 in 70 for another seed that any of all 500,000 pairs does.
TEST_F(PlaceRankingTest, KeepsThosePlacesThatMatchBest) {
  EXPECT_EQ(best(3), (std::vector{3, 1, 4}));
  EXPECT_EQ(best(1), std::vector{3});
}

TEST_F(PlaceRankingTest, WithoutAChoiceTheMostAlikeStayFirst) {
  for (const int retrieved : {5, 9}) EXPECT_EQ(best(retrieved), (std::vector{0, 1, 2, 3, 4}));
}

TEST_F(PlaceRankingTest, LooksAtTheStrongestFeatures) {
  FeatureSet query = randomFeatures(FeatureKind::orb, 500, random_);
  query.descriptors.bottomRows(200) = query_.descriptors;
  EXPECT_EQ(bestMatched(places_, query, map_, {.retrieved = 2}), (std::vector{0, 1})) << "none of the strongest match";
}

TEST_F(PlaceRankingTest, NoFeaturesNoPreference) {
  EXPECT_EQ(bestMatched(places_, randomFeatures(FeatureKind::orb, 0, random_), map_, {.retrieved = 2}),
            (std::vector{0, 1}));
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/place_recognition.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_texture.h"

namespace vmcl {
namespace {

class Vlad : public testing::TestWithParam<FeatureKind> {
 protected:
  Vlad() {
    for (int i = 0; i < 6; ++i) sets_.push_back(randomFeatures(GetParam(), 100, random_));
    for (const FeatureSet& set : sets_) pointers_.push_back(&set);
    vocabulary_ = VladVocabulary::train(pointers_, 8, 1);
  }

  Random random_{17};
  std::vector<FeatureSet> sets_;
  std::vector<const FeatureSet*> pointers_;
  VladVocabulary vocabulary_;
};

TEST_P(Vlad, IsAUnitVector) {
  const Eigen::VectorXf place = vocabulary_.describe(sets_[0]);
  EXPECT_EQ(place.size(), vocabulary_.words().size());
  EXPECT_NEAR(place.norm(), 1, 1e-5);
  EXPECT_NEAR(place.dot(vocabulary_.describe(sets_[0])), 1, 1e-5);
}

TEST_P(Vlad, DoesNotDependOnTheOrderOfFeatures) {
  FeatureSet reversed = sets_[0];
  reversed.descriptors = sets_[0].descriptors.colwise().reverse().eval();
  EXPECT_NEAR(vocabulary_.describe(reversed).dot(vocabulary_.describe(sets_[0])), 1, 1e-4);
}

TEST_P(Vlad, IsZeroWithoutFeatures) {
  EXPECT_EQ(vocabulary_.describe(randomFeatures(GetParam(), 0, random_)).norm(), 0);
}

// Half a set is like its whole by about 0.7, and like another set by 0 +- 0.06 (1 / sqrt of at least 256 dimensions):
// to be mistaken takes over ten standard deviations, a chance below 1e-20.
TEST_P(Vlad, KnowsASetByHalfOfIt) {
  Eigen::MatrixXf places(vocabulary_.words().size(), 6);
  for (int i = 0; i < 6; ++i) places.col(i) = vocabulary_.describe(sets_[static_cast<std::size_t>(i)]);
  for (int i = 0; i < 6; ++i) {
    FeatureSet half = sets_[static_cast<std::size_t>(i)];
    half.pixels.resize(50);
    half.descriptors = half.descriptors.topRows(50).eval();
    EXPECT_EQ(retrieve(places, vocabulary_.describe(half), 1).at(0).index, i);
  }
}

TEST_P(Vlad, SameSeedSameWords) {
  EXPECT_EQ(VladVocabulary::train(pointers_, 8, 1).words(), vocabulary_.words());
  EXPECT_NE(VladVocabulary::train(pointers_, 8, 2).words(), vocabulary_.words());
}

TEST_P(Vlad, WordsComeBackFromStorage) {
  const VladVocabulary stored(GetParam(), vocabulary_.words());
  EXPECT_EQ(stored.kind(), GetParam());
  EXPECT_EQ(stored.describe(sets_[2]), vocabulary_.describe(sets_[2]));
}

TEST_P(Vlad, FindsClusters) {
  FeatureSet centres = randomFeatures(GetParam(), 5, random_), samples = randomFeatures(GetParam(), 500, random_);
  for (int i = 0; i < 500; ++i) samples.descriptors.row(i) = centres.descriptors.row(i % 5);
  const FeatureSet* set = &samples;
  const VladVocabulary vocabulary = VladVocabulary::train({&set, 1}, 5, 3);
  ASSERT_EQ(vocabulary.words().rows(), 5);
  EXPECT_NEAR(vocabulary.describe(centres).norm(), 0, 1e-6) << "every sample should be a word";
  // Only five different samples: more words are not to be had.
  EXPECT_EQ(VladVocabulary::train({&set, 1}, 64, 3).words().rows(), 5);
}

TEST_P(Vlad, RefusesWhatItCannotDo) {
  EXPECT_THROW(VladVocabulary::train({}, 8, 1), std::invalid_argument);
  EXPECT_THROW(VladVocabulary::train(pointers_, 0, 1), std::invalid_argument);
  const FeatureKind other_kind = GetParam() == FeatureKind::orb ? FeatureKind::sift : FeatureKind::orb;
  const FeatureSet other = randomFeatures(other_kind, 10, random_);
  pointers_.push_back(&other);
  EXPECT_THROW(VladVocabulary::train(pointers_, 8, 1), std::invalid_argument);
  EXPECT_THROW(vocabulary_.describe(other), std::invalid_argument);
  EXPECT_THROW(VladVocabulary().describe(other), std::invalid_argument);
  EXPECT_THROW(VladVocabulary(GetParam(), Eigen::MatrixXf::Zero(8, 5)), std::invalid_argument);
  Eigen::MatrixXf words = vocabulary_.words();
  words(0, 0) = std::nanf("");
  EXPECT_THROW(VladVocabulary(GetParam(), words), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Vlad, testing::Values(FeatureKind::orb, FeatureKind::sift),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

TEST(Retrieve, AgreesWithSortingAll) {
  Random random(23);
  Eigen::MatrixXf places(20, 50);
  for (float& value : places.reshaped()) value = static_cast<float>(random.normal());
  places.col(31) = places.col(8);  // a tie
  const Eigen::VectorXf query = places.col(8);
  std::vector<std::pair<float, int>> expected;
  for (int i = 0; i < 50; ++i) expected.emplace_back(-places.col(i).dot(query), i);
  std::sort(expected.begin(), expected.end());
  const auto retrieved = retrieve(places, query, 10);
  ASSERT_EQ(retrieved.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(retrieved[i].index, expected[i].second);
    EXPECT_NEAR(retrieved[i].similarity, -expected[i].first, 1e-4);
  }
  EXPECT_EQ(retrieve(places, query, 1000).size(), 50u);
  EXPECT_TRUE(retrieve(places, query, 0).empty());
  EXPECT_THROW(retrieve(places, Eigen::VectorXf::Zero(19), 3), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/place_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

/// Twenty views each of so many places; views of one place are alike by 0.83, others by 0.17 +- 0.03.
Eigen::MatrixXf views(int places, int entries, uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXf all(entries, 20 * places);
  Eigen::VectorXf place(entries);
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    if (i % 20 == 0)
      for (float& value : place) value = static_cast<float>(random.normal());
    for (Eigen::Index k = 0; k < entries; ++k) all(k, i) = place[k] + 0.5f * static_cast<float>(random.normal()) + 0.5f;
    all.col(i).normalize();
  }
  return all;
}

void expectSame(const std::vector<RetrievedPlace>& found, const std::vector<RetrievedPlace>& exact) {
  ASSERT_EQ(found.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_EQ(found[i].index, exact[i].index);
    EXPECT_NEAR(found[i].similarity, exact[i].similarity, 1e-5f);
  }
}

// Signs of views of one place are alike by 0.6, of others by 0.1 +- 0.03: that a thousand of these come before it has a
// chance below 1e-40.
TEST(PlaceIndex, FindsAmongManyWhatAnExactSearchFinds) {
  const Eigen::MatrixXf places = views(80, 1300, 1);
  const PlaceIndex index(places);
  for (int i = 0; i < 1600; i += 97) {
    const std::vector<RetrievedPlace> found = index.retrieve(places.col(i), 20);
    expectSame(found, retrieve(places, places.col(i), 20));
    for (const RetrievedPlace& place : found) EXPECT_EQ(place.index / 20, i / 20);
  }
}

TEST(PlaceIndex, IsExactAmongFew) {
  const Eigen::MatrixXf places = views(50, 100, 2);
  const Eigen::VectorXf query = views(1, 100, 3).col(0);
  expectSame(PlaceIndex(places).retrieve(query, 900), retrieve(places, query, 900));
}

// A place that lacks most words has few entries that can agree; these alone tell.
TEST(PlaceIndex, EntriesThatAPlaceLacksDoNotCount) {
  Eigen::MatrixXf places = views(80, 1300, 5);
  const Eigen::VectorXf query = places.col(700);
  places.col(3) = query;
  places.col(3).tail(1000).setZero();
  places.col(3).normalize();
  places.col(4).setZero();
  const PlaceIndex index(places);
  const auto exact = retrieve(places, query, 30);
  ASSERT_EQ(std::ranges::count(exact, 3, &RetrievedPlace::index), 1);
  expectSame(index.retrieve(query, 30), exact);
}

TEST(PlaceIndex, AsManyAsAskedFor) {
  const Eigen::MatrixXf places = views(60, 500, 4);
  const PlaceIndex index(places);
  const Eigen::VectorXf query = places.col(7);
  EXPECT_TRUE(index.retrieve(query, 0).empty());
  EXPECT_EQ(index.retrieve(query, PlaceIndex::shortlist).size(), 1000u);
  expectSame(index.retrieve(query, 1100), retrieve(places, query, 1100));
  EXPECT_THROW(index.retrieve(query.head(499), 3), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl

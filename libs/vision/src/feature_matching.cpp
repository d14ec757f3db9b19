// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/feature_matching.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

constexpr int32_t no_distance = std::numeric_limits<int32_t>::max();

/// The nearest and how near the second nearest is.
struct Nearest {
  int row = -1;
  int32_t distance = no_distance;
  int32_t second_distance = no_distance;

  void offer(int candidate_row, int32_t candidate_distance) {
    if (candidate_distance < distance) {
      second_distance = distance;
      distance = candidate_distance;
      row = candidate_row;
    } else if (candidate_distance < second_distance) {
      second_distance = candidate_distance;
    }
  }
};

/// Number of bits that differ, by adding up neighbours within words (Warren, Hacker's Delight, section 5-1). Sums stay
/// below 256 a byte for up to 31 words.
int32_t hammingDistance(const uint32_t* a, const uint32_t* b, Eigen::Index words) {
  uint32_t sums = 0;
  for (Eigen::Index i = 0; i < words; ++i) {
    uint32_t bits = a[i] ^ b[i];
    bits -= bits >> 1 & 0x55555555u;
    bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
    sums += (bits + (bits >> 4)) & 0x0f0f0f0fu;
  }
  sums = (sums & 0x00ff00ffu) + (sums >> 8 & 0x00ff00ffu);
  return static_cast<int32_t>((sums & 0xffffu) + (sums >> 16));
}

int32_t dotProduct(const int16_t* a, const int16_t* b, Eigen::Index size) {
  int32_t sum = 0;
  for (Eigen::Index i = 0; i < size; ++i) sum += int32_t{a[i]} * b[i];
  return sum;
}

/// Distances of one query descriptor at a time to all of the reference. Exact; plain loops without branches, which
/// compilers turn into vector instructions, several times as fast as cv::batchDistance.
class HammingDistances {
 public:
  HammingDistances(const Descriptors& query, const Descriptors& reference)
      : query_(toWords(query)), reference_(toWords(reference)) {}

  void ofQuery(Eigen::Index query, std::span<int32_t> distances) const {
    for (Eigen::Index j = 0; j < reference_.rows(); ++j)
      distances[static_cast<std::size_t>(j)] =
          hammingDistance(query_.row(query).data(), reference_.row(j).data(), query_.cols());
  }

 private:
  using Words = Eigen::Matrix<uint32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  static Words toWords(const Descriptors& descriptors) {
    Words words(descriptors.rows(), descriptors.cols() / 4);
    std::memcpy(words.data(), descriptors.data(), static_cast<std::size_t>(descriptors.size()));
    return words;
  }

  Words query_, reference_;
};

class SquaredEuclideanDistances {
 public:
  SquaredEuclideanDistances(const Descriptors& query, const Descriptors& reference)
      : query_(query.cast<int16_t>()),
        reference_(reference.cast<int16_t>()),
        query_norms_(query_.cast<int32_t>().rowwise().squaredNorm()),
        reference_norms_(reference_.cast<int32_t>().rowwise().squaredNorm()) {}

  void ofQuery(Eigen::Index query, std::span<int32_t> distances) const {
    for (Eigen::Index j = 0; j < reference_.rows(); ++j)
      distances[static_cast<std::size_t>(j)] =
          query_norms_[query] + reference_norms_[j] -
          2 * dotProduct(query_.row(query).data(), reference_.row(j).data(), query_.cols());
  }

 private:
  using Wide = Eigen::Matrix<int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Wide query_, reference_;
  Eigen::VectorXi query_norms_, reference_norms_;
};

struct NearestPairs {
  std::vector<Nearest> of_query, of_reference;
};

template <class DistanceKind>
NearestPairs nearestPairs(const Descriptors& query, const Descriptors& reference) {
  const DistanceKind kind(query, reference);
  const auto references = static_cast<std::size_t>(reference.rows());
  NearestPairs nearest{std::vector<Nearest>(static_cast<std::size_t>(query.rows())), std::vector<Nearest>(references)};
  std::vector<int32_t> distances(references);
  for (int i = 0; i < query.rows(); ++i) {
    kind.ofQuery(i, distances);
    for (std::size_t j = 0; j < references; ++j) {
      nearest.of_query[static_cast<std::size_t>(i)].offer(static_cast<int>(j), distances[j]);
      nearest.of_reference[j].offer(i, distances[j]);
    }
  }
  return nearest;
}

float ratioOf(const Nearest& nearest, FeatureKind kind) {
  if (nearest.second_distance == 0 || nearest.second_distance == no_distance) return 1;
  const float ratio = static_cast<float>(nearest.distance) / static_cast<float>(nearest.second_distance);
  return kind == FeatureKind::orb ? ratio : std::sqrt(ratio);
}

}  // namespace

void MatchingOptions::check() const {
  if (!(max_ratio > 0 && max_ratio <= 1))
    throw std::invalid_argument("max_ratio is " + std::to_string(max_ratio) + ", not in (0, 1]");
}

std::vector<FeatureMatch> matchFeatures(const FeatureSet& query, const FeatureSet& reference,
                                        const MatchingOptions& options) {
  options.check();
  if (query.kind != reference.kind) throw std::invalid_argument("features of different kinds cannot be matched");
  std::vector<FeatureMatch> matches;
  if (query.size() == 0 || reference.size() == 0) return matches;

  const auto [of_query, of_reference] =
      query.kind == FeatureKind::orb
          ? nearestPairs<HammingDistances>(query.descriptors, reference.descriptors)
          : nearestPairs<SquaredEuclideanDistances>(query.descriptors, reference.descriptors);
  for (int i = 0; i < query.size(); ++i) {
    const Nearest& nearest = of_query[static_cast<std::size_t>(i)];
    if (of_reference[static_cast<std::size_t>(nearest.row)].row != i) continue;
    const float ratio = ratioOf(nearest, query.kind);
    if (ratio <= options.max_ratio) matches.push_back({i, nearest.row, ratio});
  }
  return matches;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/feature_matching.h"

#include <cmath>
#include <cstring>
#include <limits>
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

/// One row a query. Exact; plain loops without branches, which compilers turn into vector instructions, several times
/// as fast as cv::batchDistance.
using Distances = Eigen::Matrix<int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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

Distances hammingDistances(const Descriptors& query, const Descriptors& reference) {
  using Words = Eigen::Matrix<uint32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto toWords = [](const Descriptors& descriptors) {
    Words words(descriptors.rows(), descriptors.cols() / 4);
    std::memcpy(words.data(), descriptors.data(), static_cast<std::size_t>(descriptors.size()));
    return words;
  };
  const Words a = toWords(query), b = toWords(reference);
  Distances distances(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < b.rows(); ++j)
      distances(i, j) = hammingDistance(a.row(i).data(), b.row(j).data(), a.cols());
  return distances;
}

int32_t dotProduct(const int16_t* a, const int16_t* b, Eigen::Index size) {
  int32_t sum = 0;
  for (Eigen::Index i = 0; i < size; ++i) sum += int32_t{a[i]} * b[i];
  return sum;
}

Distances squaredEuclideanDistances(const Descriptors& query, const Descriptors& reference) {
  using Wide = Eigen::Matrix<int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Wide a = query.cast<int16_t>(), b = reference.cast<int16_t>();
  const Eigen::VectorXi a_norms = a.cast<int32_t>().rowwise().squaredNorm();
  const Eigen::VectorXi b_norms = b.cast<int32_t>().rowwise().squaredNorm();
  Distances distances(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < b.rows(); ++j)
      distances(i, j) = a_norms[i] + b_norms[j] - 2 * dotProduct(a.row(i).data(), b.row(j).data(), a.cols());
  return distances;
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

  const Distances distances = query.kind == FeatureKind::orb
                                  ? hammingDistances(query.descriptors, reference.descriptors)
                                  : squaredEuclideanDistances(query.descriptors, reference.descriptors);
  std::vector<Nearest> of_query(static_cast<std::size_t>(query.size()));
  std::vector<Nearest> of_reference(static_cast<std::size_t>(reference.size()));
  for (int i = 0; i < query.size(); ++i)
    for (int j = 0; j < reference.size(); ++j) {
      of_query[static_cast<std::size_t>(i)].offer(j, distances(i, j));
      of_reference[static_cast<std::size_t>(j)].offer(i, distances(i, j));
    }
  for (int i = 0; i < query.size(); ++i) {
    const Nearest& nearest = of_query[static_cast<std::size_t>(i)];
    if (options.mutual && of_reference[static_cast<std::size_t>(nearest.row)].row != i) continue;
    const float ratio = ratioOf(nearest, query.kind);
    if (ratio <= options.max_ratio) matches.push_back({i, nearest.row, ratio});
  }
  return matches;
}

}  // namespace vmcl

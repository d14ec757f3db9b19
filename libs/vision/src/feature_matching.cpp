// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/feature_matching.h"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
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

cv::Mat wrap(const Descriptors& descriptors) {
  return {static_cast<int>(descriptors.rows()), static_cast<int>(descriptors.cols()), CV_8U,
          const_cast<uint8_t*>(descriptors.data())};
}

/// Hamming for ORB, squared Euclidean for SIFT, one row a query; integers, hence exact.
cv::Mat distances(const FeatureSet& query, const FeatureSet& reference) {
  cv::Mat result;
  cv::batchDistance(wrap(query.descriptors), wrap(reference.descriptors), result, CV_32S, cv::noArray(),
                    query.kind == FeatureKind::orb ? cv::NORM_HAMMING : cv::NORM_L2SQR);
  return result;
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

  const cv::Mat distance = distances(query, reference);
  std::vector<Nearest> of_query(static_cast<std::size_t>(query.size()));
  std::vector<Nearest> of_reference(static_cast<std::size_t>(reference.size()));
  for (int i = 0; i < query.size(); ++i) {
    const int32_t* row = distance.ptr<int32_t>(i);
    for (int j = 0; j < reference.size(); ++j) {
      of_query[static_cast<std::size_t>(i)].offer(j, row[j]);
      of_reference[static_cast<std::size_t>(j)].offer(i, row[j]);
    }
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

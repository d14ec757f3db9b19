// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/guided_matching.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace vmcl {
namespace {

constexpr double gate = 11.83;      // of squared normalized residuals: 99.7 % for two degrees of freedom
constexpr double compared_px = 48;  // to each side at least, where the second nearest is sought
constexpr double none = std::numeric_limits<double>::infinity();

/// Hamming, or Euclidean.
double distanceBetween(const FeatureSet& a, int row_of_a, const FeatureSet& b, int row_of_b) {
  const uint8_t* x = a.descriptors.row(row_of_a).data();
  const uint8_t* y = b.descriptors.row(row_of_b).data();
  const Eigen::Index bytes = a.descriptors.cols();
  int sum = 0;
  if (!isBinary(a.kind)) {
    for (Eigen::Index i = 0; i < bytes; ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
    return std::sqrt(sum);
  }
  for (Eigen::Index i = 0; i < bytes; i += 4) {  // whole words, whatever the kind
    uint32_t of_x = 0, of_y = 0;
    std::memcpy(&of_x, x + i, 4);
    std::memcpy(&of_y, y + i, 4);
    sum += std::popcount(of_x ^ of_y);
  }
  return sum;
}

/// The features of an image by place.
class FeatureGrid {
 public:
  explicit FeatureGrid(const FeatureSet& features) {
    for (int i = 0; i < features.size(); ++i) {
      const Eigen::Vector2d pixel = features.pixels[static_cast<std::size_t>(i)].cast<double>();
      cells_[cellOf(pixel.x())][cellOf(pixel.y())].push_back(i);
    }
  }

  /// Visits those in the cells that the rectangle touches.
  template <class Visit>
  void visit(const Eigen::Vector2d& center, const Eigen::Vector2d& half_size, Visit&& visit) const {
    const Eigen::Vector2d low = center - half_size, high = center + half_size;
    for (auto column = cells_.lower_bound(cellOf(low.x())); column != cells_.end() && column->first <= cellOf(high.x());
         ++column)
      for (auto cell = column->second.lower_bound(cellOf(low.y()));
           cell != column->second.end() && cell->first <= cellOf(high.y()); ++cell)
        std::ranges::for_each(cell->second, visit);
  }

 private:
  static int cellOf(double coordinate) {
    constexpr double cell = 32, most = 1 << 20;  // pixels
    return static_cast<int>(std::floor(std::clamp(coordinate, -most, most) / cell));
  }

  std::map<int, std::map<int, std::vector<int>>> cells_;  ///< by column and row
};

struct Candidate {
  FeatureMatch match;
  double distance = none;
};

Candidate nearestOf(const ExpectedFeature& expected, const FeatureSet& query, const FeatureGrid& grid,
                    const FeatureSet& reference) {
  const Eigen::Matrix2d& covariance = expected.covariance;
  const double determinant = covariance.determinant();
  if (expected.reference < 0 || expected.reference >= reference.size())
    throw std::invalid_argument("no row " + std::to_string(expected.reference) + " in the reference");
  if (!(covariance(0, 0) > 0 && determinant > 0 && expected.query_pixel.allFinite()))
    throw std::invalid_argument("a feature is expected at a pixel without a covariance");
  const Eigen::Matrix2d information = covariance.inverse();
  Candidate nearest{{-1, expected.reference, 1, std::numbers::pi * gate * std::sqrt(determinant)}};
  double second = none;
  grid.visit(expected.query_pixel, (gate * covariance.diagonal()).cwiseSqrt().cwiseMax(compared_px), [&](int row) {
    const Eigen::Vector2d residual = query.pixels[static_cast<std::size_t>(row)].cast<double>() - expected.query_pixel;
    const double distance = distanceBetween(query, row, reference, expected.reference);
    const bool is_nearest = residual.dot(information * residual) < gate && distance < nearest.distance;
    second = std::min(second, is_nearest ? nearest.distance : distance);
    if (is_nearest) std::tie(nearest.match.query, nearest.distance) = std::pair(row, distance);
  });
  nearest.match.ratio = second > 0 && second < none ? static_cast<float>(nearest.distance / second) : 1.0f;
  return nearest;
}

}  // namespace

std::vector<FeatureMatch> matchExpected(const FeatureSet& query, const FeatureSet& reference,
                                        std::span<const ExpectedFeature> expected, const MatchingOptions& options) {
  options.check();
  if (query.kind != reference.kind ||
      (query.size() > 0 && reference.size() > 0 && query.descriptors.cols() != reference.descriptors.cols()))
    throw std::invalid_argument("features of different kinds cannot be matched");
  const FeatureGrid grid(query);
  std::map<int, Candidate> by_query;
  for (const ExpectedFeature& feature : expected) {
    const Candidate candidate = nearestOf(feature, query, grid, reference);
    if (candidate.match.query < 0 || candidate.match.ratio > options.max_ratio) continue;
    Candidate& known = by_query[candidate.match.query];
    if (candidate.distance < known.distance) known = candidate;
  }
  std::vector<FeatureMatch> matches;
  for (const auto& [row, candidate] : by_query) matches.push_back(candidate.match);
  return matches;
}

}  // namespace vmcl

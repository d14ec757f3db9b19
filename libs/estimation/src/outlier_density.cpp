// SPDX-License-Identifier: BSD-3-Clause
#include "outlier_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vmcl {
namespace {

/// Elevation of a ray on a scale that is linear near the horizon, where pixel noise counts, and logarithmic beyond: the
/// hyperbolic area sine of this.
double steepness(const Eigen::Vector3d& direction) {
  constexpr double horizon = 0.01;  // slope up to which the scale is linear
  constexpr double zenith = 1e-6;   // nearer to it the scale ends
  const double across2 = direction.head<2>().squaredNorm() + zenith * zenith * direction.squaredNorm();
  return direction.z() / (horizon * std::sqrt(across2));
}

/// A match as its elevation in the query image, less that in the reference image.
struct ElevationChange {
  double change = 0;
  double per_image = 0;  ///< change over the height of the query image at the rate that it has at this pixel
};

ElevationChange elevationChange(const PoseProblem& problem, const Match& match) {
  const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
  const ReferenceCamera& reference = problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
  const auto at = [&](const Eigen::Vector2d& pixel) {
    return steepness(query.robot_from_camera.linear() * query.camera.ray(pixel));
  };
  const double here = at(match.query_pixel);
  const double there = steepness(reference.map_from_camera.linear() * reference.camera.ray(match.reference_pixel));
  const Eigen::Vector2d slope(at(match.query_pixel + Eigen::Vector2d::UnitX()) - here,
                              at(match.query_pixel + Eigen::Vector2d::UnitY()) - here);
  const double rate = slope.norm() / std::sqrt(1 + here * here);
  return {std::asinh(here) - std::asinh(there), rate * query.camera.height};
}

double levelDensity(const ElevationChange& c, double spread) {
  const double z = c.change / spread;
  return std::exp(-0.5 * z * z) / (spread * std::sqrt(2 * std::numbers::pi)) * c.per_image;
}

}  // namespace

OutlierDensity::OutlierDensity(const PoseProblem& problem) {
  constexpr double prior_share = 0.5;   // before any match is seen
  constexpr double prior_spread = 0.7;  // likewise, of the factor's logarithm: half or twice is one deviation
  constexpr double pseudo_matches = 4;  // that stand for both priors
  constexpr double max_share = 0.9;     // some matches lie anywhere
  constexpr int max_iterations = 10;    // of expectation maximization
  constexpr double settled = 1e-3;      // of spread and share
  std::vector<ElevationChange> changes;
  for (const Match& match : problem.matches) changes.push_back(elevationChange(problem, match));
  share_ = prior_share;
  double spread = prior_spread;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    double count = pseudo_matches * prior_share, sum_of_squares = count * prior_spread * prior_spread;
    for (const ElevationChange& c : changes) {
      const double of_level = share_ * levelDensity(c, spread), responsibility = of_level / (of_level + 1 - share_);
      count += responsibility;
      sum_of_squares += responsibility * c.change * c.change;
    }
    const double last_share =
        std::exchange(share_, std::min(max_share, count / (pseudo_matches + static_cast<double>(changes.size()))));
    const double last_spread = std::exchange(spread, std::sqrt(sum_of_squares / count));
    if (std::abs(share_ - last_share) < settled && std::abs(spread - last_spread) < settled) break;
  }
  for (const ElevationChange& c : changes) level_.push_back(levelDensity(c, spread));
}

std::vector<double> OutlierDensity::at(double inlier_prior) const {
  const double share = std::max(0.0, (share_ - inlier_prior) / (1 - inlier_prior));
  std::vector<double> density;
  for (const double level : level_) density.push_back(share * level + 1 - share);
  return density;
}

}  // namespace vmcl

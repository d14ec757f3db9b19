// SPDX-License-Identifier: BSD-3-Clause
#include "likelihood_terms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "match_likelihood.h"

namespace vmcl {
namespace {

constexpr double reach = 1e6;      // m, pixels over sigma: fourth powers are within single precision
constexpr double widest = 1e3;     // m on the ground: rounding stays below a millimetre
constexpr double gate_room = 1.1;  // of a gate's cutoff, for rounding

using Row3 = Eigen::RowVector3d;

/// Rows of the camera in robot axes: the image axes times focal length over sigma, and forward.
Eigen::Matrix3d axesOf(const QueryCamera& query, double sigma_px) {
  const Eigen::Vector3d scale(query.camera.fx / sigma_px, query.camera.fy / sigma_px, 1);
  return scale.asDiagonal() * query.robot_from_camera.linear().transpose();
}

Eigen::Vector2d fromPrincipalPoint(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return pixel - Eigen::Vector2d(camera.cx, camera.cy);
}

/// normal . (p - camera) over the ground part of p, whose height is known.
PlaneRow<double> overPosition(const Row3& normal, const QueryCamera& query, double height) {
  const Eigen::Vector3d below(0, 0, height);
  return {normal.x(), normal.y(), normal.dot(below - query.robot_from_camera.translation())};
}

/// normal . R^T direction over (cos phi, sin phi), R the robot's rotation.
PlaneRow<double> overHeading(const Row3& normal, const Eigen::Vector3d& direction_in_map) {
  const Eigen::Vector3d& g = direction_in_map;
  return {normal.x() * g.x() + normal.y() * g.y(), normal.x() * g.y() - normal.y() * g.x(), normal.z() * g.z()};
}

PlaneRow<float> rounded(const PlaneRow<double>& row) {
  return {static_cast<float>(row.x), static_cast<float>(row.y), static_cast<float>(row.constant)};
}

/// Lower triangular L by columns with L L^T = C, for C positive semidefinite.
std::array<float, 6> choleskyRoot(Eigen::Matrix3d C) {
  const double least_pivot = 1e-14 * C.trace();
  std::array<float, 6> root{};
  auto next = root.begin();
  for (int k = 0; k < 3; ++k) {
    const double pivot = C(k, k);
    const double scale = pivot > least_pivot ? 1 / std::sqrt(pivot) : 0;
    const Eigen::Vector3d column = scale * C.col(k);
    for (int i = k; i < 3; ++i) *next++ = static_cast<float>(column[i]);
    C -= column * column.transpose();
  }
  return root;
}

/// Slack of a gate for rounding: single precision keeps positions to this part of the extent.
double roundingSlack(const QueryCamera& query, double sigma_px, double extent) {
  const double rounding = 4e-7 * extent * std::max(query.camera.fx, query.camera.fy) / sigma_px;
  return rounding * rounding;
}

PointTerms pointTerms(const PointGroup& group, const QueryCamera& query, const LikelihoodOptions& options,
                      const Eigen::Vector2d& origin, double extent) {
  const Eigen::Matrix3d axes = axesOf(query, options.sigma_px);
  PointTerms result;
  result.image_x = axes.row(0).cast<float>();
  result.image_y = axes.row(1).cast<float>();
  result.forward = axes.row(2).cast<float>();
  const double peak = peakOdds(query.camera, options), cutoff = cutoffDistance2(query.camera, options);
  result.cutoff = static_cast<float>(cutoff);
  result.gate_cutoff = static_cast<float>(gate_room * cutoff);
  const double slack = roundingSlack(query, options.sigma_px, extent);
  const double focal2 = axes.topRows<2>().rowwise().squaredNorm().maxCoeff();
  for (std::size_t i = 0; i < group.match.size(); ++i) {
    const Eigen::Vector3d& X = group.point_in_map[i];
    const Eigen::Vector2d pixel = fromPrincipalPoint(query.camera, group.pixel[i]) / options.sigma_px;
    const Eigen::Vector2d ground = X.head<2>() - origin;
    const PointRows<double> rows{
        ground.x(), ground.y(), overPosition(axes.row(0) - pixel.x() * axes.row(2), query, X.z()),
        overPosition(axes.row(1) - pixel.y() * axes.row(2), query, X.z()), overPosition(axes.row(2), query, X.z())};
    result.terms.push_back({rows, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                            choleskyRoot(group.covariance[i]), static_cast<float>(peak * group.worth[i])});
    // Squared norm of the derivative of the pixel by the point, times depth^2: focal^2 + |p|^2 with the predicted pixel
    // p from the principal point, and |p|^2 <= 1.5 |observed|^2 + 3 e2 / depth^2.
    const double steepness = focal2 + 1.5 * pixel.squaredNorm();
    const double variance = group.covariance[i].cwiseAbs().rowwise().sum().maxCoeff();
    result.gates.push_back({{static_cast<float>(rows.x), static_cast<float>(rows.y), rounded(rows.u), rounded(rows.v),
                             rounded(rows.depth)},
                            static_cast<float>(3 * gate_room * cutoff * variance),
                            static_cast<float>(steepness * variance + slack)});
  }
  return result;
}

RayTerms rayTerms(const RayGroup& group, const QueryCamera& query, const ReferenceCamera& reference,
                  const LikelihoodOptions& options, const InverseDepthPrior& prior, const Eigen::Vector2d& origin,
                  double extent) {
  const double sigma = options.sigma_px;
  const Eigen::Matrix3d axes = axesOf(query, sigma), axes_px = axesOf(query, 1);
  const Eigen::Matrix3d map_from_pixel = reference.map_from_camera.linear() * reference.camera.inverseMatrix();
  const double height = reference.map_from_camera.translation().z();
  RayTerms result;
  result.reference = reference.map_from_camera.translation().head<2>() - origin;
  result.parallax_depth = overPosition(axes.row(2), query, height);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k)
      result.homography[std::size_t(i)][std::size_t(k)] = rounded(overHeading(axes_px.row(i), map_from_pixel.col(k)));
  result.sigma_px = static_cast<float>(sigma);
  const double peak = peakOdds(query.camera, options), cutoff = cutoffDistance2(query.camera, options);
  result.cutoff = static_cast<float>(cutoff);
  result.gate_cutoff = static_cast<float>(gate_room * cutoff);
  result.prior_mean = static_cast<float>(prior.mean);
  result.prior_variance = static_cast<float>(prior.sigma * prior.sigma);
  result.tiny_parallax2 = static_cast<float>(tiny_parallax2 / (sigma * sigma));
  result.segment_scale =
      static_cast<float>(2 * std::numbers::pi * sigma * sigma / (double(query.camera.width) * query.camera.height));
  const double slack = roundingSlack(query, sigma, 1 + max_inverse_depth * extent);
  const double by_reference2 = map_from_pixel.leftCols<2>().colwise().squaredNorm().maxCoeff();
  const double focal2_px = axes_px.topRows<2>().rowwise().squaredNorm().maxCoeff();
  for (std::size_t i = 0; i < group.match.size(); ++i) {
    const Eigen::Vector3d direction = map_from_pixel * group.reference_pixel[i].homogeneous();
    const Eigen::Vector2d pixel_px = fromPrincipalPoint(query.camera, group.query_pixel[i]), pixel = pixel_px / sigma;
    const Row3 across = axes.row(0) - pixel.x() * axes.row(2), down = axes.row(1) - pixel.y() * axes.row(2);
    const RayRows<double> rows{overHeading(across, direction), overHeading(down, direction),
                               overHeading(axes.row(2), direction), overPosition(across, query, height),
                               overPosition(down, query, height)};
    result.terms.push_back({rows, static_cast<float>(pixel_px.x()), static_cast<float>(pixel_px.y()),
                            static_cast<float>(peak * group.worth[i])});
    const double steepness = by_reference2 * (focal2_px + 1.5 * pixel_px.squaredNorm());  // as for points
    result.gates.push_back({{rounded(rows.infinite_u), rounded(rows.infinite_v), rounded(rows.infinite_depth),
                             rounded(rows.parallax_u), rounded(rows.parallax_v)},
                            static_cast<float>(3 * gate_room * cutoff * sigma * sigma * by_reference2),
                            static_cast<float>(steepness + slack)});
  }
  return result;
}

/// Whether single precision holds all numbers of the problem, but for where on the ground the map is.
bool fitsSinglePrecision(const MatchGroups& matches, const LikelihoodOptions& options) {
  const double sigma = options.sigma_px;
  const auto cameraFits = [&](const PinholeCamera& camera, const Rigid3& pose) {
    return std::max({camera.fx, camera.fy, std::abs(camera.cx), std::abs(camera.cy)}) < reach * std::min(sigma, 1.0) &&
           std::min(camera.fx, camera.fy) > 1 && std::abs(pose.translation().z()) < reach;
  };
  const auto queryPixelFits = [&](const Eigen::Vector2d& pixel) { return pixel.norm() < reach * std::min(sigma, 1.0); };
  const auto referencePixelFits = [](const Eigen::Vector2d& pixel) { return pixel.norm() < reach; };
  const auto pointFits = [](const Eigen::Vector3d& point) { return std::abs(point.z()) < reach; };
  const auto covarianceFits = [](const Eigen::Matrix3d& covariance) { return covariance.trace() < 1e4; };
  return sigma >= 0.01 && sigma <= 1e4 &&
         std::ranges::all_of(matches.query_cameras,
                             [&](const QueryCamera& query) {
                               return cameraFits(query.camera, query.robot_from_camera) &&
                                      query.robot_from_camera.translation().norm() < reach;
                             }) &&
         std::ranges::all_of(matches.reference_cameras,
                             [&](const ReferenceCamera& reference) {
                               return cameraFits(reference.camera, reference.map_from_camera);
                             }) &&
         std::ranges::all_of(matches.points,
                             [&](const PointGroup& group) {
                               return std::ranges::all_of(group.pixel, queryPixelFits) &&
                                      std::ranges::all_of(group.point_in_map, pointFits) &&
                                      std::ranges::all_of(group.covariance, covarianceFits);
                             }) &&
         std::ranges::all_of(matches.rays, [&](const RayGroup& group) {
           return std::ranges::all_of(group.query_pixel, queryPixelFits) &&
                  std::ranges::all_of(group.reference_pixel, referencePixelFits);
         });
}

/// Positions on the ground that the terms hold.
std::vector<Eigen::Vector2d> places(const MatchGroups& matches) {
  std::vector<Eigen::Vector2d> result;
  for (const PointGroup& group : matches.points)
    for (const Eigen::Vector3d& point : group.point_in_map) result.push_back(point.head<2>());
  for (const RayGroup& group : matches.rays)
    result.push_back(matches.reference_cameras[std::size_t(group.reference)].map_from_camera.translation().head<2>());
  return result;
}

}  // namespace

std::optional<LikelihoodTerms> likelihoodTerms(const MatchGroups& matches, const LikelihoodOptions& options,
                                               const InverseDepthPrior& prior, double outlier_sum) {
  if (!fitsSinglePrecision(matches, options)) return std::nullopt;
  LikelihoodTerms result;
  const std::vector<Eigen::Vector2d> all = places(matches);
  result.origin.setZero();
  for (const Eigen::Vector2d& place : all) result.origin += place / static_cast<double>(all.size());
  double extent = 0;
  for (const Eigen::Vector2d& place : all) extent = std::max(extent, (place - result.origin).norm());
  if (!(extent < widest)) return std::nullopt;

  double largest_worth = 1;
  const auto addWorth = [&](const auto& groups) {
    for (const auto& group : groups)
      for (const double worth : group.worth) largest_worth = std::max(largest_worth, worth);
  };
  addWorth(matches.points);
  addWorth(matches.rays);
  double largest_factor = 1;
  for (const QueryCamera& query : matches.query_cameras)
    largest_factor = std::max(largest_factor, 1 + peakOdds(query.camera, options) * largest_worth);
  result.matches_per_renormal = static_cast<int>(std::min(125 / std::log2(largest_factor), 1e6));
  if (result.matches_per_renormal < 1) return std::nullopt;
  result.outlier_sum = outlier_sum;
  const auto queryOf = [&](const auto& group) { return matches.query_cameras[std::size_t(group.query)]; };
  for (const PointGroup& group : matches.points)
    result.points.push_back(pointTerms(group, queryOf(group), options, result.origin, extent));
  for (const RayGroup& group : matches.rays)
    result.rays.push_back(rayTerms(group, queryOf(group), matches.reference_cameras[std::size_t(group.reference)],
                                   options, prior, result.origin, extent));
  return result;
}

bool isWithinReach(const LikelihoodTerms& terms, const PlanarTransform& pose) {
  return std::abs(pose.x - terms.origin.x()) < widest && std::abs(pose.y - terms.origin.y()) < widest &&
         std::abs(pose.c * pose.c + pose.s * pose.s - 1) < 1e-9;
}

}  // namespace vmcl

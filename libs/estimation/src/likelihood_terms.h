// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "inverse_depth_prior.h"
#include "match_groups.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/planar_slope.h"

namespace vmcl {

/// x * h.x + y * h.y + constant, for a vector h in the ground plane.
template <class T>
struct PlaneRow {
  T x, y, constant;
};

/// A match with depth: the point's position on the ground and, over its position in the robot frame, its depth in the
/// query camera and u, v: depth times (predicted minus observed pixel), in units of the pixel noise.
template <class T>
struct PointRows {
  T x, y;
  PlaneRow<T> u, v, depth;
};

/// A match without depth: the homogeneous query pixel, as above, of a point with inverse depth rho on the reference ray
/// is infinite + rho * parallax; rows over (cos phi, sin phi) and over the reference's position in the robot frame.
template <class T>
struct RayRows {
  PlaneRow<T> infinite_u, infinite_v, infinite_depth, parallax_u, parallax_v;
};

/// Tells in single precision whether a match may add anything at a pose, where e2 = u^2 + v^2:
///     e2 (depth^2 - pole) < gate_cutoff depth^2 (depth^2 + spread).
/// Never says no wrongly: pole and spread bound the covariance of the residual from above.
template <class Rows>
struct MatchGate {
  Rows rows;
  float pole, spread;
};

struct PointTerm {
  PointRows<double> rows;
  float pixel_u, pixel_v;                ///< observed, from the principal point, in units of the pixel noise
  std::array<float, 6> covariance_root;  ///< lower triangular L by columns, L L^T = covariance of the point
  float peak_odds;                       ///< of an inlier without residual, nor covariance of the point
};

struct RayTerm {
  RayRows<double> rows;
  float pixel_u_px, pixel_v_px;  ///< observed, from the principal point
  float peak_odds;               ///< of an inlier without residual, nor covariance of the point
};

/// Matches with depth seen by one query camera.
struct PointTerms {
  Eigen::Vector3f image_x, image_y, forward;  ///< camera axes in the robot frame; the first two times focal / sigma
  float cutoff;                               ///< squared normalized residuals beyond it add nothing
  float gate_cutoff;                          ///< the same with room for rounding
  std::vector<MatchGate<PointRows<float>>> gates;
  std::vector<PointTerm> terms;
};

/// Matches without depth between one query and one reference camera.
struct RayTerms {
  Eigen::Vector2d reference;                                 ///< position on the ground
  PlaneRow<double> parallax_depth;                           ///< over the reference's position in the robot frame
  std::array<std::array<PlaneRow<float>, 2>, 3> homography;  ///< at infinity, over (cos phi, sin phi), two columns
  float sigma_px;
  float cutoff, gate_cutoff;
  float prior_mean, prior_variance;  ///< of the inverse depth
  float tiny_parallax2;              ///< keeps the inverse depth defined where there is no baseline
  float segment_scale;               ///< 2 pi sigma^2 / image area
  std::vector<MatchGate<RayRows<float>>> gates;
  std::vector<RayTerm> terms;
};

/// All that the likelihood of planar poses needs, free of the poses: positions on the ground relative to `origin`, so
/// that single precision is enough far from the origin of the map.
struct LikelihoodTerms {
  Eigen::Vector2d origin;
  double outlier_sum;        ///< L of a pose that explains nothing
  int matches_per_renormal;  ///< so many factors 1 + odds stay within single precision
  std::vector<PointTerms> points;
  std::vector<RayTerms> rays;
};

/// Nothing where a number is too large or too small for single precision: positions over 1 km apart, noise outside
/// of [0.01, 1e4] px, focal lengths or pixels of 1e6 times the noise, points known to 100 m only.
std::optional<LikelihoodTerms> likelihoodTerms(const MatchGroups& matches, const LikelihoodOptions& options,
                                               const InverseDepthPrior& prior, double outlier_sum);

/// Whether evaluateTerms may be called: a rotation, within 1 km of the matches.
bool isWithinReach(const LikelihoodTerms& terms, const PlanarTransform& map_from_robot);

/// L at poses within reach.
void evaluateTerms(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                   std::span<double> log_likelihoods);
void linearizeTerms(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                    std::span<PlanarSlope> slopes);

}  // namespace vmcl

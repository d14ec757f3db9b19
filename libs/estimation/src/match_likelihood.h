// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "inverse_depth_prior.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

inline constexpr double min_depth = 0.05;  ///< points nearer than this to the image plane are behind the camera (m)

/// Cosine of the widest angle to the optical axis, about, at which a point without depth is in front of the camera.
inline constexpr double min_ray_depth = 1e-3;

inline constexpr double tiny_parallax2 = 1e-12;    ///< px^2 m^2: keeps the inverse depth defined without a baseline
inline constexpr double tiny_information = 1e-12;  ///< m^2: keeps its variance finite

/// Inverse depth is sought up to this: nothing is nearer to the reference than 0.2 m.
inline constexpr double max_inverse_depth = 5;

/// Variance of the relative depth of a point that the prior does not describe: unknown to a factor of 10.
inline constexpr double unknown_scale = 100;

/// Share of the points without depth that the prior of the inverse depth describes.
inline constexpr double described_share = 0.7;

/// What the prior counts for where the pose is sought, over what it would if it told of each match by itself: it is
/// one prior, learned from few points, so that its error is common to all.
inline constexpr double prior_weight = 0.3;

/// Odds that a match of exact points and no residual is an inlier.
inline double peakOdds(const PinholeCamera& camera, const LikelihoodOptions& options) {
  const double odds = options.inlier_prior / (1 - options.inlier_prior);
  const double area = double(camera.width) * camera.height;
  return odds * area / (2 * std::numbers::pi * options.sigma_px * options.sigma_px);
}

/// Squared normalized residual beyond which a match adds less than 1e-7 to L, and counts as nothing.
inline double cutoffDistance2(const PinholeCamera& camera, const LikelihoodOptions& options) {
  return 2 * std::log(1e7 * std::max(peakOdds(camera, options), 1.0));
}

/// Lets points fade out within twice the minimal depth, so smoothly that rounding of the depth does no harm.
inline double nearFade(double excess_depth) {
  const double visible = std::clamp(excess_depth / min_depth, 0.0, 1.0);
  return visible * visible;
}

/// A match against one pose of the robot. The scene point is X = t + arm / scale, t the robot's position: moving the
/// robot by dt and turning it about an axis w moves the predicted pixel by pixel_by_point * (arm x w - scale dt).
struct MatchResidual {
  Eigen::Vector2d pixel_error;  ///< predicted minus observed
  Eigen::Matrix2d information;  ///< inverse of the error's covariance
  Eigen::Matrix<double, 2, 3> pixel_by_point;
  Eigen::Vector3d arm;
  double scale = 1;
  double likelihood_ratio = 0;  ///< p / u: density of the error over that of an outlier anywhere in the image
  double noise_fit = 0;         ///< the error's share in an estimate of the pixel noise's variance, over the variance
  double noise_freedom = 0;     ///< expected of noise_fit

  /// From pixel_error and its covariance S.
  void setLikelihood(const Eigen::Matrix2d& S, double image_area, double cutoff) {
    const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
    information << S(1, 1), -S(0, 1), -S(1, 0), S(0, 0);
    information /= determinant;
    const double distance2 = pixel_error.dot(information * pixel_error);
    likelihood_ratio = distance2 < cutoff
                           ? image_area * std::exp(-0.5 * distance2) / (2 * std::numbers::pi * std::sqrt(determinant))
                           : 0;
  }
};

/// A query camera at one pose of the robot, for matches with depth.
class PointView {
 public:
  PointView(const QueryCamera& query, const Rigid3& map_from_robot, const LikelihoodOptions& options)
      : position_(map_from_robot.translation()),
        sigma2_(options.sigma_px * options.sigma_px),
        area_(double(query.camera.width) * query.camera.height),
        cutoff_(cutoffDistance2(query.camera, options)) {
    const Rigid3 map_from_camera = map_from_robot * query.robot_from_camera;
    pixel_from_map_.noalias() = query.camera.matrix() * map_from_camera.linear().transpose();
    offset_ = -pixel_from_map_ * map_from_camera.translation();
  }

  /// Reprojection: the pixel noise plus the point's covariance carried into the image. Without derivatives, only the
  /// likelihood ratio.
  template <bool with_derivatives>
  void evaluate(const Eigen::Vector2d& pixel, const Eigen::Vector3d& point, const Eigen::Matrix3d& covariance,
                MatchResidual& result) const {
    result.likelihood_ratio = 0;
    const Eigen::Vector3d h = pixel_from_map_ * point + offset_;
    if (!(h.z() > min_depth)) return;
    const double inverse_depth = 1 / h.z();
    const Eigen::Vector2d predicted = h.head<2>() * inverse_depth;
    result.pixel_error = predicted - pixel;
    result.pixel_by_point = (pixel_from_map_.topRows<2>() - predicted * pixel_from_map_.row(2)) * inverse_depth;
    const double largest_variance = sigma2_ + result.pixel_by_point.squaredNorm() * covariance.trace();
    if (result.pixel_error.squaredNorm() > cutoff_ * largest_variance) return;
    Eigen::Matrix2d S = result.pixel_by_point * covariance * result.pixel_by_point.transpose();
    S.diagonal().array() += sigma2_;
    result.setLikelihood(S, area_, cutoff_);
    result.likelihood_ratio *= nearFade(h.z() - min_depth);
    if (!with_derivatives) return;
    result.arm = point - position_;
    result.scale = 1;
    result.noise_fit = sigma2_ * (result.information * result.pixel_error).squaredNorm();
    result.noise_freedom = sigma2_ * result.information.trace();
  }

 private:
  Eigen::Matrix3d pixel_from_map_;  // homogeneous pixel of a map point: pixel_from_map * X + offset
  Eigen::Vector3d offset_;
  Eigen::Vector3d position_;
  double sigma2_;
  double area_;
  double cutoff_;
};

/// A query and a reference camera at one pose of the robot, for matches without depth: the point lies somewhere on the
/// reference ray and its inverse depth rho is marginalized out. Most points have an inverse depth as the prior says;
/// the rest may lie anywhere along the epipolar line, whatever the baseline, so that a wrong prior cannot fix the
/// scale.
///
/// Near infinity and at vanishing baseline, where the epipolar constraint alone fits any pose, the segment shrinks to
/// the pixel noise and the match becomes one of bearings.
class RayView {
 public:
  RayView(const QueryCamera& query, const ReferenceCamera& reference, const Rigid3& map_from_robot,
          const LikelihoodOptions& options, const InverseDepthPrior& prior)
      : reference_from_robot_(reference.map_from_camera.translation() - map_from_robot.translation()),
        prior_(prior),
        sigma2_(options.sigma_px * options.sigma_px),
        area_(double(query.camera.width) * query.camera.height),
        cutoff_(cutoffDistance2(query.camera, options)) {
    const Rigid3 map_from_camera = map_from_robot * query.robot_from_camera;
    pixel_from_map_.noalias() = query.camera.matrix() * map_from_camera.linear().transpose();
    map_from_reference_pixel_.noalias() = reference.map_from_camera.linear() * reference.camera.inverseMatrix();
    pixel_from_reference_pixel_.noalias() = pixel_from_map_ * map_from_reference_pixel_;
    parallax_.noalias() = pixel_from_map_ * (reference.map_from_camera.translation() - map_from_camera.translation());
  }

  /// Without derivatives, only the likelihood ratio.
  template <bool with_derivatives>
  void evaluate(const Eigen::Vector2d& query_pixel, const Eigen::Vector2d& reference_pixel,
                MatchResidual& result) const {
    result.likelihood_ratio = 0;
    // The homogeneous query pixel of the point is a + rho * parallax.
    const Eigen::Vector3d a =
        pixel_from_reference_pixel_.leftCols<2>() * reference_pixel + pixel_from_reference_pixel_.col(2);
    const double rho = nearestInverseDepth(query_pixel, a);
    const Eigen::Vector3d h = a + rho * parallax_;
    if (!(h.z() > std::max(rho * min_depth, min_ray_depth))) return;
    const double inverse_z = 1 / h.z();
    const Eigen::Vector2d predicted = h.head<2>() * inverse_z;
    result.pixel_error = predicted - query_pixel;
    const Eigen::Matrix2d by_reference_pixel =
        (pixel_from_reference_pixel_.topLeftCorner<2, 2>() - predicted * pixel_from_reference_pixel_.row(2).head<2>()) *
        inverse_z;
    const double largest_variance = sigma2_ * (1 + by_reference_pixel.squaredNorm());
    if (result.pixel_error.squaredNorm() > cutoff_ * largest_variance) return;
    Eigen::Matrix2d S = sigma2_ * by_reference_pixel * by_reference_pixel.transpose();
    S.diagonal().array() += sigma2_;
    result.setLikelihood(S, area_, cutoff_);
    if (result.likelihood_ratio <= 0) return;

    const Eigen::Vector2d by_rho = (parallax_.head<2>() - predicted * parallax_.z()) * inverse_z;
    const double rho_variance =
        1 / (by_rho.dot(result.information * by_rho) + tiny_information);  // as this match measures it
    const double described = described_share * describedDensity(rho, rho_variance);
    const double anywhere = (1 - described_share) * anywhereDensity(rho_variance, by_rho.squaredNorm());
    result.likelihood_ratio *= nearFade(h.z() - rho * min_depth) * (described + anywhere);
    if (!with_derivatives) return;
    result.noise_fit = result.pixel_error.dot(result.information * result.pixel_error);
    result.noise_freedom = 1;
    weigh(by_rho, rho, rho_variance, described / (described + anywhere), result);
    result.pixel_by_point = (pixel_from_map_.topRows<2>() - predicted * pixel_from_map_.row(2)) * inverse_z;
    result.arm = map_from_reference_pixel_ * reference_pixel.homogeneous() + rho * reference_from_robot_;
    result.scale = rho;
  }

 private:
  /// Inverse depth in [0, max_rho] that comes nearest to the observed query ray.
  double nearestInverseDepth(const Eigen::Vector2d& query_pixel, const Eigen::Vector3d& a) const {
    const Eigen::Vector2d u = a.head<2>() - query_pixel * a.z(), v = parallax_.head<2>() - query_pixel * parallax_.z();
    return std::clamp(-u.dot(v) / (v.squaredNorm() + tiny_parallax2), 0.0, max_inverse_depth);
  }

  /// Densities at rho, smoothed by its measurement, over the peak of the measurement's density: of points that the
  /// prior describes, and of points anywhere along the epipolar line.
  double describedDensity(double rho, double rho_variance) const {
    const double spread = rho_variance + prior_.sigma * prior_.sigma, off = rho - prior_.mean;
    return std::sqrt(rho_variance / spread) * std::exp(-0.5 * off * off / spread);
  }
  double anywhereDensity(double rho_variance, double by_rho2) const {
    return std::min(std::sqrt(2 * std::numbers::pi * rho_variance * by_rho2 / area_), 1.0);
  }

  /// The one Gaussian that pulls as both do, the prior as far as it counts: a point that the prior describes has its
  /// error at the prior's mean, with the prior's spread along the segment; any other says nothing there, but for the
  /// bearing of a point near infinity. A variance v along the segment changes the information W to W - v / (1 + v /
  /// rho_variance) W b b^T W, b = by_rho.
  void weigh(const Eigen::Vector2d& by_rho, double rho, double rho_variance, double chance_described,
             MatchResidual& result) const {
    const double prior_variance = prior_.sigma * prior_.sigma;
    const double unknown_variance = unknown_scale * rho * rho + rho_variance;
    const double prior_share = prior_weight * chance_described;
    const double described = prior_share / (1 + prior_variance / rho_variance);
    const double anywhere = (1 - prior_share) / (1 + unknown_variance / rho_variance);
    const Eigen::Vector2d along = result.information * by_rho;
    result.information -= (described * prior_variance + anywhere * unknown_variance) * along * along.transpose();
    result.pixel_error += described / (described + anywhere) * (prior_.mean - rho) * by_rho;
  }

  Eigen::Matrix3d pixel_from_map_;
  Eigen::Matrix3d map_from_reference_pixel_;    // direction with depth 1 along the reference's optical axis
  Eigen::Matrix3d pixel_from_reference_pixel_;  // of points at infinity
  Eigen::Vector3d parallax_;
  Eigen::Vector3d reference_from_robot_;
  InverseDepthPrior prior_;
  double sigma2_;
  double area_;
  double cutoff_;
};

}  // namespace vmcl

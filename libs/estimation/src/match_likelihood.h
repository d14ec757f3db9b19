// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

inline constexpr double min_depth = 0.05;    ///< points nearer than this to the image plane are behind the camera (m)
inline constexpr double max_distance2 = 60;  ///< squared normalized residuals over this add nothing (e^-30)

inline Eigen::Matrix3d intrinsics(const PinholeCamera& camera) {
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return K;
}

inline Eigen::Matrix3d inverseIntrinsics(const PinholeCamera& camera) {
  Eigen::Matrix3d K;
  K << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy, 0, 0, 1;
  return K;
}

/// A query camera looking at scene points from one pose of the robot.
struct PointView {
  Eigen::Matrix3d pixel_from_map;  ///< homogeneous pixel of a map point: pixel_from_map * X + offset
  Eigen::Vector3d offset;
  double sigma2;
  double area;

  PointView(const QueryCamera& query, const Rigid3& map_from_robot, double sigma_px)
      : sigma2(sigma_px * sigma_px), area(double(query.camera.width) * query.camera.height) {
    const Rigid3 map_from_camera = map_from_robot * query.robot_from_camera;
    pixel_from_map.noalias() = intrinsics(query.camera) * map_from_camera.linear().transpose();
    offset = -pixel_from_map * map_from_camera.translation();
  }

  struct Residual {
    Eigen::Vector2d pixel_error;  ///< predicted minus observed
    Eigen::Matrix2d information;  ///< inverse of the residual's covariance
    Eigen::Matrix<double, 2, 3> pixel_by_point;
    double likelihood_ratio = 0;  ///< p / u; 0 behind the camera
  };

  void evaluate(const Eigen::Vector2d& pixel, const Eigen::Vector3d& point, const Eigen::Matrix3d& covariance,
                Residual& result) const {
    result.likelihood_ratio = 0;
    const Eigen::Vector3d h = pixel_from_map * point + offset;
    if (!(h.z() > min_depth)) return;
    const double inverse_depth = 1 / h.z();
    const Eigen::Vector2d predicted = h.head<2>() * inverse_depth;
    result.pixel_error = predicted - pixel;
    result.pixel_by_point = (pixel_from_map.topRows<2>() - predicted * pixel_from_map.row(2)) * inverse_depth;
    Eigen::Matrix2d S = result.pixel_by_point * covariance * result.pixel_by_point.transpose();
    S(0, 0) += sigma2;
    S(1, 1) += sigma2;
    const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
    result.information << S(1, 1), -S(0, 1), -S(1, 0), S(0, 0);
    result.information /= determinant;
    const double distance2 = result.pixel_error.dot(result.information * result.pixel_error);
    if (!(distance2 < max_distance2)) return;
    result.likelihood_ratio = area * std::exp(-0.5 * distance2) / (2 * std::numbers::pi * std::sqrt(determinant));
  }
};

/// A query and a reference camera from one pose of the robot.
struct EpipolarView {
  Eigen::Matrix3d fundamental;  ///< query^T F reference = 0
  Eigen::Matrix3d map_from_query_pixel;
  Eigen::Matrix3d map_from_reference_pixel;
  Eigen::Vector3d baseline;  ///< query centre minus reference centre, map frame
  double sigma;
  double width, height;

  EpipolarView(const QueryCamera& query, const ReferenceCamera& reference, const Rigid3& map_from_robot,
               double sigma_px)
      : sigma(sigma_px), width(query.camera.width), height(query.camera.height) {
    const Rigid3 map_from_camera = map_from_robot * query.robot_from_camera;
    map_from_query_pixel.noalias() = map_from_camera.linear() * inverseIntrinsics(query.camera);
    map_from_reference_pixel.noalias() = reference.map_from_camera.linear() * inverseIntrinsics(reference.camera);
    baseline = map_from_camera.translation() - reference.map_from_camera.translation();
    // Coplanar: f . (b x g) = 0.
    Eigen::Matrix3d b_cross_g;
    for (int k = 0; k < 3; ++k) b_cross_g.col(k) = baseline.cross(map_from_reference_pixel.col(k));
    fundamental.noalias() = map_from_query_pixel.transpose() * b_cross_g;
  }

  struct Residual {
    double sampson = 0;           ///< signed, pixels
    double norm = 0;              ///< of the constraint's gradient over the four pixel coordinates
    double likelihood_ratio = 0;  ///< p / u; 0 behind a camera
  };

  void evaluate(const Eigen::Vector2d& query_pixel, const Eigen::Vector2d& reference_pixel, Residual& result) const {
    result.likelihood_ratio = 0;
    const Eigen::Vector3d line = fundamental.leftCols<2>() * reference_pixel + fundamental.col(2);
    const Eigen::Vector2d back =
        fundamental.topLeftCorner<2, 2>().transpose() * query_pixel + fundamental.row(2).head<2>().transpose();
    const double constraint = line.head<2>().dot(query_pixel) + line.z();
    const double query_norm2 = line.head<2>().squaredNorm();
    const double norm2 = query_norm2 + back.squaredNorm();
    if (!(norm2 > 0)) return;
    const double distance2 = constraint * constraint / (norm2 * sigma * sigma);
    if (!(distance2 < max_distance2) || !inFront(query_pixel, reference_pixel)) return;
    result.norm = std::sqrt(norm2);
    result.sampson = constraint / result.norm;
    // An outlier falls anywhere in the query image; its Sampson residual spans the image's extent across the epipolar
    // line, shrunk by the query's share of the gradient.
    const double span = (width * std::abs(line.x()) + height * std::abs(line.y())) / result.norm;
    result.likelihood_ratio = span * std::exp(-0.5 * distance2) / (std::sqrt(2 * std::numbers::pi) * sigma);
  }

  /// Whether the rays meet in front of both cameras; rays parallel within the pixel noise meet at infinity.
  bool inFront(const Eigen::Vector2d& query_pixel, const Eigen::Vector2d& reference_pixel) const {
    const Eigen::Vector3d f = map_from_query_pixel.leftCols<2>() * query_pixel + map_from_query_pixel.col(2);
    const Eigen::Vector3d g =
        map_from_reference_pixel.leftCols<2>() * reference_pixel + map_from_reference_pixel.col(2);
    const Eigen::Vector3d n = f.cross(g);
    const double parallel = sigma * map_from_query_pixel.col(0).norm();  // angle of one sigma
    const double n2 = n.squaredNorm(), scale2 = f.squaredNorm() * g.squaredNorm();
    if (n2 < 4 * parallel * parallel * scale2) return f.dot(g) > 0;
    return baseline.cross(g).dot(n) < 0 && baseline.cross(f).dot(n) < 0;
  }
};

}  // namespace vmcl

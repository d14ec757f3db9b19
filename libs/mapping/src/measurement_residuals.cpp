// SPDX-License-Identifier: BSD-3-Clause
#include "measurement_residuals.h"

#include <cmath>

namespace vmcl {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr double nearest_depth = 1e-3;  // m; a point driven behind the camera stays there and is culled
constexpr double max_r2 = 4;            // 63 deg off the axis, where a point driven aside must not rule the distortion

/// R^T p with R = rotationFromRollPitchYaw(angles), and its derivatives by these.
struct TurnedBack {
  Matrix3d R_transposed;
  Vector3d point;
  Matrix3d by_angles;

  TurnedBack(const Vector3d& angles, const Vector3d& p) {
    const Eigen::Array3d c = angles.array().cos(), s = angles.array().sin();
    Matrix3d unroll, unpitch, unyaw;
    unroll << 1, 0, 0, 0, c[0], s[0], 0, -s[0], c[0];
    unpitch << c[1], 0, -s[1], 0, 1, 0, s[1], 0, c[1];
    unyaw << c[2], s[2], 0, -s[2], c[2], 0, 0, 0, 1;
    const Matrix3d untilt = unroll * unpitch;
    const Vector3d unyawed = unyaw * p, unpitched = unpitch * unyawed;
    R_transposed = untilt * unyaw;
    point = unroll * unpitched;
    by_angles.col(0) << 0, point.z(), -point.y();
    by_angles.col(1) = unroll * Vector3d(-unpitched.z(), 0, unpitched.x());
    by_angles.col(2) = untilt * Vector3d(unyawed.y(), -unyawed.x(), 0);
  }
};

/// A point of the map in the optical frame of the camera. It does not depend on the lens.
Linearized<3> pointInCamera(const MeasuringCamera& from, const Stand& stand, const CorrectionVector& correction,
                            const Vector3d& point_in_map) {
  const Rigid3 &mount = from.camera->robot_from_camera, &level_from_robot = *from.level_from_robot;
  const TurnedBack on_level(stand.head<3>(), point_in_map - stand.tail<3>());
  const Vector3d point_in_robot =
      level_from_robot.linear().transpose() * (on_level.point - level_from_robot.translation());
  const TurnedBack on_mount(correction.head<3>(), point_in_robot - mount.translation() - correction.segment<3>(3));
  const Matrix3d camera_from_mount = mount.linear().transpose();
  const Matrix3d camera_from_robot = camera_from_mount * on_mount.R_transposed;
  const Matrix3d camera_from_level = camera_from_robot * level_from_robot.linear().transpose();
  Linearized<3> in_camera;
  in_camera.error = camera_from_mount * on_mount.point;
  in_camera.by_point = camera_from_level * on_level.R_transposed;
  in_camera.by_stand << camera_from_level * on_level.by_angles, -in_camera.by_point;
  in_camera.by_correction << camera_from_mount * on_mount.by_angles, -camera_from_robot, Matrix3d::Zero();
  return in_camera;
}

/// The derivatives of what depends on the point in the camera, but for the lens.
template <int rows>
Linearized<rows> through(const Linearized<3>& in_camera, const Eigen::Matrix<double, rows, 3>& by_point_in_camera) {
  return {{},
          by_point_in_camera * in_camera.by_stand,
          by_point_in_camera * in_camera.by_correction,
          by_point_in_camera * in_camera.by_point};
}

}  // namespace

Stand standOf(const Reconstruction& scene, std::size_t keyframe) {
  const PlanarPose& pose = scene.map_from_robot[keyframe];
  const Vector3d& stance = scene.stance[keyframe];
  return {stance.x(), stance.y(), pose.phi, pose.x, pose.y, stance.z()};
}

CorrectionVector correctionVector(const CameraCorrection& correction) {
  return (CorrectionVector() << correction.rotation, correction.shift, correction.lens).finished();
}

// CameraCalibration::distort, with focal length, k1 and k2 changed by the lens.
Linearized<2> PixelMeasurement::linearize(const Stand& stand, const CorrectionVector& correction,
                                          const Vector3d& point_in_map) const {
  const Linearized<3> in_camera = pointInCamera(from, stand, correction, point_in_map);
  const Vector3d& p = in_camera.error;
  const bool in_front = p.z() > nearest_depth;
  const double depth = in_front ? p.z() : nearest_depth;
  const double x = p.x() / depth, y = p.y() / depth;
  Eigen::Matrix<double, 2, 3> normalized_by_p;
  normalized_by_p << 1 / depth, 0, in_front ? -x / depth : 0, 0, 1 / depth, in_front ? -y / depth : 0;

  const auto& [given_k1, given_k2, p1, p2, k3] = from.camera->calibration.distortion;
  const double k1 = given_k1 + correction[7], k2 = given_k2 + correction[8];
  const bool near_axis = x * x + y * y < max_r2;
  const double r2 = near_axis ? x * x + y * y : max_r2;
  const double factor = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double factor_by_r2 = near_axis ? k1 + r2 * (2 * k2 + r2 * 3 * k3) : 0;
  const Eigen::Vector2d bent(factor * x + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                             factor * y + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y);
  const Eigen::RowVector2d r2_by_xy = near_axis ? Eigen::RowVector2d(2 * x, 2 * y) : Eigen::RowVector2d(0, 0);
  Eigen::Matrix2d bent_by_xy = (Eigen::Vector2d(x, y) * factor_by_r2 + Eigen::Vector2d(p2, p1)) * r2_by_xy;
  bent_by_xy(0, 0) += factor + 2 * p1 * y + 4 * p2 * x;
  bent_by_xy(0, 1) += 2 * p1 * x;
  bent_by_xy(1, 0) += 2 * p2 * y;
  bent_by_xy(1, 1) += factor + 4 * p1 * y + 2 * p2 * x;

  const PinholeCamera& pinhole = from.camera->calibration.pinhole;
  const Eigen::Vector2d given_focal = Eigen::Vector2d(pinhole.fx, pinhole.fy) / sigma_px;
  const Eigen::Vector2d focal = (1 + correction[6]) * given_focal;
  Linearized<2> seen = through<2>(in_camera, focal.asDiagonal() * bent_by_xy * normalized_by_p);
  seen.error = focal.cwiseProduct(bent) + (Eigen::Vector2d(pinhole.cx, pinhole.cy) - pixel) / sigma_px;
  seen.by_correction.col(6) = given_focal.cwiseProduct(bent);
  seen.by_correction.col(7) = r2 * focal.cwiseProduct(Eigen::Vector2d(x, y));
  seen.by_correction.col(8) = r2 * seen.by_correction.col(7);
  return seen;
}

Linearized<1> DepthMeasurement::linearize(const Stand& stand, const CorrectionVector& correction,
                                          const Vector3d& point_in_map) const {
  const Linearized<3> in_camera = pointInCamera(from, stand, correction, point_in_map);
  const double z = in_camera.error.z();
  const bool in_front = z > nearest_depth;
  Linearized<1> measured = through<1>(in_camera, Eigen::RowVector3d(0, 0, in_front ? -1 / (z * z * sigma) : 0));
  measured.error[0] = (1 / (in_front ? z : nearest_depth) - 1 / depth) / sigma;
  return measured;
}

}  // namespace vmcl

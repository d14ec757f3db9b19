// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/autodiff_cost_function.h>

#include "reconstruction.h"

namespace vmcl {

inline constexpr double nearest_depth = 1e-3;  ///< m; a point driven behind the camera stays there and is culled

/// Whence a measurement was taken, as given.
struct MeasuringCamera {
  const MapCamera* camera;
  const Rigid3* level_from_robot;  ///< as in Reconstruction
};

/// As seen from a robot that is rolled by stance[0] and pitched by stance[1]: the inverse of rotationFromRollPitchYaw.
template <typename T>
Eigen::Matrix<T, 3, 1> untilted(const Eigen::Matrix<T, 3, 1>& p, const T* stance) {
  using std::cos, std::sin;
  const T c_roll = cos(stance[0]), s_roll = sin(stance[0]), c_pitch = cos(stance[1]), s_pitch = sin(stance[1]);
  const T up = s_pitch * p.x() + c_pitch * p.z();
  return {c_pitch * p.x() - s_pitch * p.z(), c_roll * p.y() + s_roll * up, c_roll * up - s_roll * p.y()};
}

/// A point of the map in the optical frame of a camera of the robot at the planar pose (x, y, phi), which stands off
/// the level by `stance` (Reconstruction).
template <typename T>
Eigen::Matrix<T, 3, 1> pointInCamera(const MeasuringCamera& from, const T* map_from_robot, const T* stance,
                                     const T* mount_rotation, const T* mount_shift, const T* point_in_map) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  using std::cos, std::sin;
  const T c = cos(map_from_robot[2]), s = sin(map_from_robot[2]);
  const T dx = point_in_map[0] - map_from_robot[0], dy = point_in_map[1] - map_from_robot[1];
  const Vector point_on_level = untilted<T>({c * dx + s * dy, c * dy - s * dx, point_in_map[2] - stance[2]}, stance);
  const Rigid3& mount = from.camera->robot_from_camera;
  const Vector point_in_robot = from.level_from_robot->linear().transpose().cast<T>() *
                                (point_on_level - from.level_from_robot->translation().cast<T>());
  const Vector from_mount = point_in_robot - mount.translation().cast<T>() - Eigen::Map<const Vector>(mount_shift);
  const Vector uncorrected =
      rotationFromRollPitchYaw<T>(Eigen::Map<const Vector>(mount_rotation)).transpose() * from_mount;
  return mount.linear().transpose().cast<T>() * uncorrected;
}

/// Reprojection error in standard deviations, a function of the robot's planar pose (x, y, phi) and stance, the
/// correction of the camera (mount rotation, mount shift, lens, radial distortion) and the point; for automatic
/// differentiation by Ceres.
struct ReprojectionResidual {
  MeasuringCamera from;
  Eigen::Vector2d pixel;  ///< of the real image
  double sigma_px;

  template <typename T>
  bool operator()(const T* map_from_robot, const T* stance, const T* mount_rotation, const T* mount_shift,
                  const T* lens, const T* radial, const T* point_in_map, T* residual) const {
    const auto p = pointInCamera(from, map_from_robot, stance, mount_rotation, mount_shift, point_in_map);
    const PinholeCamera& pinhole = from.camera->calibration.pinhole;
    const T depth = p.z() > nearest_depth ? p.z() : T(nearest_depth);
    const T focal_scale = 1.0 + lens[0];
    const Eigen::Matrix<T, 2, 1> bent = distorted<T>({p.x() / depth, p.y() / depth}, radial);
    residual[0] = (focal_scale * pinhole.fx * bent.x() + pinhole.cx + lens[1] - pixel.x()) / sigma_px;
    residual[1] = (focal_scale * pinhole.fy * bent.y() + pinhole.cy + lens[2] - pixel.y()) / sigma_px;
    return true;
  }

  /// CameraCalibration::distort in normalized coordinates, with the radial coefficients changed.
  template <typename T>
  Eigen::Matrix<T, 2, 1> distorted(const Eigen::Matrix<T, 2, 1>& p, const T* radial) const {
    const auto& [k1, k2, p1, p2, k3] = from.camera->calibration.distortion;
    constexpr double max_r2 = 4;  // 63 deg off the axis, where a point driven aside must not rule the coefficients
    const T r2 = p.squaredNorm() < max_r2 ? p.squaredNorm() : T(max_r2);
    const T factor = 1.0 + r2 * (k1 + radial[0] + r2 * (k2 + radial[1] + r2 * (k3 + radial[2])));
    const T xy = p.x() * p.y();
    return {factor * p.x() + 2 * p1 * xy + p2 * (r2 + 2.0 * p.x() * p.x()),
            factor * p.y() + p1 * (r2 + 2.0 * p.y() * p.y()) + 2 * p2 * xy};
  }
};

/// Error of the inverse of a measured depth in standard deviations, a function of pose, stance, mount and point as
/// above.
struct DepthResidual {
  MeasuringCamera from;
  double depth;  ///< along the optical axis (m)
  double sigma;  ///< of its inverse (1/m)

  template <typename T>
  bool operator()(const T* map_from_robot, const T* stance, const T* mount_rotation, const T* mount_shift,
                  const T* point_in_map, T* residual) const {
    const auto p = pointInCamera(from, map_from_robot, stance, mount_rotation, mount_shift, point_in_map);
    residual[0] = (1.0 / (p.z() > nearest_depth ? p.z() : T(nearest_depth)) - 1 / depth) / sigma;
    return true;
  }
};

/// Of Huber's loss, which every measurement has: standard deviations.
inline constexpr double huber_threshold = 2;

using DepthCost = ceres::AutoDiffCostFunction<DepthResidual, 1, 3, 3, 3, 3, 3>;
using ReprojectionCost = ceres::AutoDiffCostFunction<ReprojectionResidual, 2, 3, 3, 3, 3, 3, 3, 3>;

}  // namespace vmcl

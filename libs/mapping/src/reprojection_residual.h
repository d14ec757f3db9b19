// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/autodiff_cost_function.h>

#include "reconstruction.h"

namespace vmcl {

/// Reprojection error in standard deviations, a function of the robot's planar pose (x, y, phi), the correction of
/// the camera (mount rotation, mount shift, lens, radial distortion) and the point; for automatic differentiation by
/// Ceres.
struct ReprojectionResidual {
  const MapCamera* camera;  ///< as given
  Eigen::Vector2d pixel;    ///< of the real image
  double sigma_px;

  template <typename T>
  bool operator()(const T* map_from_robot, const T* mount_rotation, const T* mount_shift, const T* lens,
                  const T* radial, const T* point_in_map, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using std::cos, std::sin;
    const T c = cos(map_from_robot[2]), s = sin(map_from_robot[2]);
    const T dx = point_in_map[0] - map_from_robot[0], dy = point_in_map[1] - map_from_robot[1];
    const Vector point_in_robot(c * dx + s * dy, c * dy - s * dx, point_in_map[2]);
    const Vector from_mount =
        point_in_robot - camera->robot_from_camera.translation().cast<T>() - Eigen::Map<const Vector>(mount_shift);
    const Vector uncorrected =
        rotationFromRollPitchYaw<T>(Eigen::Map<const Vector>(mount_rotation)).transpose() * from_mount;
    const Vector p = camera->robot_from_camera.linear().transpose().cast<T>() * uncorrected;
    const PinholeCamera& pinhole = camera->calibration.pinhole;
    constexpr double min_depth = 1e-3;  // a point driven behind the camera stays there and is culled
    const T depth = p.z() > min_depth ? p.z() : T(min_depth);
    const T focal_scale = 1.0 + lens[0];
    const Eigen::Matrix<T, 2, 1> bent = distorted<T>({p.x() / depth, p.y() / depth}, radial);
    residual[0] = (focal_scale * pinhole.fx * bent.x() + pinhole.cx + lens[1] - pixel.x()) / sigma_px;
    residual[1] = (focal_scale * pinhole.fy * bent.y() + pinhole.cy + lens[2] - pixel.y()) / sigma_px;
    return true;
  }

  /// CameraCalibration::distort in normalized coordinates, with the radial coefficients changed.
  template <typename T>
  Eigen::Matrix<T, 2, 1> distorted(const Eigen::Matrix<T, 2, 1>& p, const T* radial) const {
    const auto& [k1, k2, p1, p2, k3] = camera->calibration.distortion;
    constexpr double max_r2 = 4;  // 63 deg off the axis, where a point driven aside must not rule the coefficients
    const T r2 = p.squaredNorm() < max_r2 ? p.squaredNorm() : T(max_r2);
    const T factor = 1.0 + r2 * (k1 + radial[0] + r2 * (k2 + radial[1] + r2 * (k3 + radial[2])));
    const T xy = p.x() * p.y();
    return {factor * p.x() + 2 * p1 * xy + p2 * (r2 + 2.0 * p.x() * p.x()),
            factor * p.y() + p1 * (r2 + 2.0 * p.y() * p.y()) + 2 * p2 * xy};
  }
};

using ReprojectionCost = ceres::AutoDiffCostFunction<ReprojectionResidual, 2, 3, 3, 3, 3, 3, 3>;

}  // namespace vmcl

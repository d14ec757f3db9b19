// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/autodiff_cost_function.h>

#include "reconstruction.h"

namespace vmcl {

/// Reprojection error in standard deviations, a function of the robot's planar pose (x, y, phi), the correction of
/// the camera (mount rotation, mount shift, lens) and the point; for automatic differentiation by Ceres.
struct ReprojectionResidual {
  const MapCamera* camera;  ///< as given
  Eigen::Vector2d pixel;
  double sigma_px;

  template <typename T>
  bool operator()(const T* map_from_robot, const T* mount_rotation, const T* mount_shift, const T* lens,
                  const T* point_in_map, T* residual) const {
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
    residual[0] = (focal_scale * pinhole.fx * p.x() / depth + pinhole.cx + lens[1] - pixel.x()) / sigma_px;
    residual[1] = (focal_scale * pinhole.fy * p.y() / depth + pinhole.cy + lens[2] - pixel.y()) / sigma_px;
    return true;
  }
};

using ReprojectionCost = ceres::AutoDiffCostFunction<ReprojectionResidual, 2, 3, 3, 3, 3, 3>;

}  // namespace vmcl

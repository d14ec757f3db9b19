// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/match_information.h"

#include <Eigen/Dense>

namespace vmcl {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// How the pixel of a map point moves with the point.
Matrix23 pixelByPoint(const PinholeCamera& camera, const Rigid3& map_from_camera, const Eigen::Vector3d& point_in_map) {
  const Eigen::Vector3d p = map_from_camera.inverse() * point_in_map;
  Matrix23 by_point_in_camera;
  by_point_in_camera << camera.fx / p.z(), 0, -camera.fx * p.x() / (p.z() * p.z()),  //
      0, camera.fy / p.z(), -camera.fy * p.y() / (p.z() * p.z());
  return by_point_in_camera * map_from_camera.linear().transpose();
}

/// How a map point moves in the robot's eyes, in map axes, when the robot moves along x, y or turns.
Eigen::Matrix3d pointByPose(const PlanarPose& map_from_robot, const Eigen::Vector3d& point_in_map) {
  const Eigen::Vector3d arm = point_in_map - Eigen::Vector3d(map_from_robot.x, map_from_robot.y, 0);
  Eigen::Matrix3d result;
  result.col(0) = -Eigen::Vector3d::UnitX();
  result.col(1) = -Eigen::Vector3d::UnitY();
  result.col(2) = -Eigen::Vector3d::UnitZ().cross(arm);
  return result;
}

}  // namespace

Eigen::Matrix3d informationWithDepth(const QueryCamera& query, const PlanarPose& map_from_robot, const MapPoint& point,
                                     double sigma_px) {
  const Matrix23 by_point =
      pixelByPoint(query.camera, toRigid3(map_from_robot) * query.robot_from_camera, point.point_in_map);
  const Matrix23 by_pose = by_point * pointByPose(map_from_robot, point.point_in_map);
  Eigen::Matrix2d S = by_point * point.covariance * by_point.transpose();
  S.diagonal().array() += sigma_px * sigma_px;
  return by_pose.transpose() * S.inverse() * by_pose;
}

/// That of the combinations of the four coordinates which do not depend on the point.
Eigen::Matrix3d informationWithoutDepth(const QueryCamera& query, const ReferenceCamera& reference,
                                        const PlanarPose& map_from_robot, const Eigen::Vector3d& point_in_map,
                                        double sigma_px) {
  using Matrix43 = Eigen::Matrix<double, 4, 3>;
  const Matrix23 query_by_point =
      pixelByPoint(query.camera, toRigid3(map_from_robot) * query.robot_from_camera, point_in_map);
  Matrix43 by_pose = Matrix43::Zero(), by_point;
  by_pose.topRows<2>() = query_by_point * pointByPose(map_from_robot, point_in_map);
  by_point << query_by_point, pixelByPoint(reference.camera, reference.map_from_camera, point_in_map);
  const Eigen::ColPivHouseholderQR<Matrix43> qr(by_point);
  if (qr.rank() < 3) return Eigen::Matrix3d::Zero();  // no baseline: any depth fits
  const Eigen::Matrix4d Q = qr.householderQ();
  const Eigen::MatrixXd free_of_point = Q.rightCols<1>().transpose() * by_pose;
  return free_of_point.transpose() * free_of_point / (sigma_px * sigma_px);
}

}  // namespace vmcl

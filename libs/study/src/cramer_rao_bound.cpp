// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/cramer_rao_bound.h"

#include <Eigen/Dense>

namespace vmcl {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Matrix43 = Eigen::Matrix<double, 4, 3>;

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

/// Information of two pixels of a point that may lie anywhere: that of the combinations of the four coordinates which
/// do not depend on the point.
Eigen::Matrix3d informationWithoutDepth(const Matrix23& query_by_pose, const Matrix23& query_by_point,
                                        const Matrix23& reference_by_point, double sigma_px) {
  Matrix43 by_pose = Matrix43::Zero(), by_point;
  by_pose.topRows<2>() = query_by_pose;
  by_point << query_by_point, reference_by_point;
  const Eigen::ColPivHouseholderQR<Matrix43> qr(by_point);
  const Eigen::Matrix4d Q = qr.householderQ();
  const Eigen::MatrixXd free_of_point = Q.rightCols(4 - qr.rank()).transpose() * by_pose;
  return free_of_point.transpose() * free_of_point / (sigma_px * sigma_px);
}

}  // namespace

Eigen::Matrix3d fisherInformation(const SimulatedProblem& simulated, double sigma_px) {
  const PoseProblem& problem = simulated.problem;
  const Rigid3 map_from_robot = toRigid3(simulated.map_from_robot);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < problem.matches.size(); ++i) {
    if (!simulated.truth[i].inlier) continue;
    const Match& match = problem.matches[i];
    const Eigen::Vector3d& point = simulated.truth[i].point_in_map;
    const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
    const Matrix23 query_by_point = pixelByPoint(query.camera, map_from_robot * query.robot_from_camera, point);
    const Matrix23 query_by_pose = query_by_point * pointByPose(simulated.map_from_robot, point);
    if (match.point) {
      Eigen::Matrix2d S = query_by_point * match.point->covariance * query_by_point.transpose();
      S.diagonal().array() += sigma_px * sigma_px;
      information += query_by_pose.transpose() * S.inverse() * query_by_pose;
    } else {
      const ReferenceCamera& reference = problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
      const Matrix23 reference_by_point = pixelByPoint(reference.camera, reference.map_from_camera, point);
      information += informationWithoutDepth(query_by_pose, query_by_point, reference_by_point, sigma_px);
    }
  }
  return information;
}

std::optional<Eigen::Matrix3d> cramerRaoBound(const SimulatedProblem& simulated, double sigma_px) {
  const Eigen::Matrix3d information = fisherInformation(simulated, sigma_px);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  if (!(eigen.eigenvalues()[0] > 1e-12 * eigen.eigenvalues()[2])) return std::nullopt;
  return information.inverse();
}

}  // namespace vmcl

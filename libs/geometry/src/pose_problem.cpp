// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/pose_problem.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void checkPlacedCamera(const PinholeCamera& camera, const Rigid3& frame_from_camera, const std::string& name) {
  try {
    camera.check();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
  require(frame_from_camera.matrix().allFinite(), name + ": pose is not finite");
  const Eigen::Matrix3d R = frame_from_camera.linear();
  require((R.transpose() * R).isIdentity(1e-6) && R.determinant() > 0, name + ": rotation is not orthonormal");
}

void checkPoint(const MapPoint& point, const std::string& name) {
  require(point.point_in_map.allFinite(), name + ": point is not finite");
  require(point.covariance.allFinite(), name + ": point covariance is not finite");
  const double scale = point.covariance.cwiseAbs().maxCoeff();
  if (scale == 0) return;
  require(point.covariance.isApprox(point.covariance.transpose(), 1e-6), name + ": point covariance is not symmetric");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(point.covariance, Eigen::EigenvaluesOnly);
  require(eigen.eigenvalues()[0] >= -1e-9 * scale, name + ": point covariance is not positive semidefinite");
}

}  // namespace

void PoseProblem::check() const {
  for (std::size_t i = 0; i < query_cameras.size(); ++i)
    checkPlacedCamera(query_cameras[i].camera, query_cameras[i].robot_from_camera, "query camera " + std::to_string(i));
  for (std::size_t i = 0; i < reference_cameras.size(); ++i)
    checkPlacedCamera(reference_cameras[i].camera, reference_cameras[i].map_from_camera,
                      "reference camera " + std::to_string(i));
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& match = matches[i];
    const std::string name = "match " + std::to_string(i);
    require(match.query_camera >= 0 && match.query_camera < static_cast<int>(query_cameras.size()),
            name + ": no query camera " + std::to_string(match.query_camera));
    require(match.reference_camera >= 0 && match.reference_camera < static_cast<int>(reference_cameras.size()),
            name + ": no reference camera " + std::to_string(match.reference_camera));
    require(match.query_pixel.allFinite() && match.reference_pixel.allFinite(), name + ": pixel is not finite");
    require(match.inlier_odds >= 1e-3 && match.inlier_odds <= 1e3, name + ": inlier odds are not in [0.001, 1000]");
    if (match.point) checkPoint(*match.point, name);
  }
}

}  // namespace vmcl

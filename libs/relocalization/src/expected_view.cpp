// SPDX-License-Identifier: BSD-3-Clause
#include "expected_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace vmcl {
namespace {

constexpr std::size_t compared_keyframes = 5;
constexpr double alike_distance = 1, alike_angle = 20 * degree;  // as unlike: this far (m), this much turned (rad)
constexpr double least_position_sigma = 0.1;                     // m; filters are surer than they should be
constexpr double least_heading_sigma = 2 * degree;               // rad
constexpr double least_depth = 0.1;                              // m

Eigen::Matrix3d checked(const ExpectedPose& expected) {
  expected.check();
  Eigen::Matrix3d covariance = expected.covariance;
  covariance.diagonal() += Eigen::Vector3d(least_position_sigma, least_position_sigma, least_heading_sigma).cwiseAbs2();
  return covariance;
}

}  // namespace

void ExpectedPose::check() const {
  if (!isFinite(robot_in_map) || !covariance.allFinite())
    throw std::invalid_argument("the expected pose is not finite");
  const double scale = covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale ||
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().minCoeff() < -1e-6 * scale)
    throw std::invalid_argument("the covariance of the expected pose is not symmetric positive semidefinite");
}

ExpectedView::ExpectedView(const KeyframeMap& map, const QueryImage& image, const ExpectedPose& expected,
                           const RelocalizerOptions& options)
    : map_(map),
      camera_(image.calibration.pinhole),
      robot_in_map_(expected.robot_in_map),
      covariance_(checked(expected)),
      map_from_camera_(toRigid3(expected.robot_in_map) * image.robot_from_camera),
      sigma_px_(std::hypot(options.estimator.likelihood.sigma_px, camera_.fx * options.estimator.plane.sigma_tilt)) {}

std::vector<int> ExpectedView::keyframes() const {
  std::vector<std::pair<double, int>> unlike;
  for (std::size_t i = 0; i < map_.keyframes.size(); ++i) {
    const Rigid3 map_from_other = map_.referenceCamera(map_.keyframes[i]).map_from_camera;
    const double distance = (map_from_other.translation() - map_from_camera_.translation()).norm();
    const double cosine = map_from_other.linear().col(2).dot(map_from_camera_.linear().col(2));
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    unlike.emplace_back(distance / alike_distance + angle / alike_angle, static_cast<int>(i));
  }
  const std::size_t count = std::min(compared_keyframes, unlike.size());
  std::ranges::partial_sort(unlike, unlike.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<int> keyframes;
  for (std::size_t i = 0; i < count; ++i) keyframes.push_back(unlike[i].second);
  return keyframes;
}

std::vector<ExpectedFeature> ExpectedView::features(const Keyframe& keyframe,
                                                    const std::vector<bool>& is_certain) const {
  const Rigid3 camera_from_map = map_from_camera_.inverse();
  std::vector<ExpectedFeature> features;
  for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i) {
    const int landmark = keyframe.landmark_of_feature[i];
    if (landmark < 0 || !is_certain[static_cast<std::size_t>(landmark)]) continue;
    const Landmark& seen = map_.landmarks[static_cast<std::size_t>(landmark)];
    const Eigen::Vector3d point = camera_from_map * seen.point_in_map;
    if (point.z() < least_depth) continue;
    const Eigen::Vector2d pixel = camera_.project(point);
    if (!camera_.contains(pixel)) continue;
    Eigen::Matrix<double, 2, 3> pixel_by_point;
    pixel_by_point << camera_.fx / point.z(), 0, -camera_.fx * point.x() / (point.z() * point.z()), 0,
        camera_.fy / point.z(), -camera_.fy * point.y() / (point.z() * point.z());
    pixel_by_point *= camera_from_map.linear();
    Eigen::Matrix3d point_by_pose = Eigen::Matrix3d::Zero();  // of a point as seen by the robot
    point_by_pose.topLeftCorner<2, 2>().setIdentity();
    point_by_pose.col(2) << robot_in_map_.y - seen.point_in_map.y(), seen.point_in_map.x() - robot_in_map_.x, 0;
    const Eigen::Matrix3d spread = point_by_pose * covariance_ * point_by_pose.transpose() + seen.covariance;
    features.push_back(
        {static_cast<int>(i), pixel,
         pixel_by_point * spread * pixel_by_point.transpose() + sigma_px_ * sigma_px_ * Eigen::Matrix2d::Identity()});
  }
  return features;
}

double ExpectedView::shareOfImage(double area_px2) const {
  return std::min(1.0, area_px2 / (static_cast<double>(camera_.width) * camera_.height));
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "truncated_residuals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>

namespace vmcl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// x in the query and x' in the reference image of one point fulfil x^T F x' = 0.
Eigen::Matrix3d fundamentalMatrix(const QueryCamera& query, const ReferenceCamera& reference,
                                  const Rigid3& map_from_robot) {
  const Rigid3 query_from_reference = (map_from_robot * query.robot_from_camera).inverse() * reference.map_from_camera;
  const Eigen::Vector3d t = query_from_reference.translation();
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  return query.camera.inverseMatrix().transpose() * cross * query_from_reference.linear() *
         reference.camera.inverseMatrix();
}

double sampsonDistance(const Eigen::Matrix3d& F, const Match& match) {
  const Eigen::Vector3d q = match.query_pixel.homogeneous(), r = match.reference_pixel.homogeneous();
  const Eigen::Vector3d line_in_query = F * r, line_in_reference = F.transpose() * q;
  const double slope2 = line_in_query.head<2>().squaredNorm() + line_in_reference.head<2>().squaredNorm();
  return slope2 > 0 ? q.dot(line_in_query) / std::sqrt(slope2) : 0;
}

PlanarTransform moved(const PlanarTransform& pose, const Eigen::Vector3d& step) {
  const double c = std::cos(step[2]), s = std::sin(step[2]);
  return {pose.c * c - pose.s * s, pose.s * c + pose.c * s, pose.x + step[0], pose.y + step[1]};
}

}  // namespace

TruncatedResiduals::TruncatedResiduals(const PoseProblem& problem, bool with_depth_only, double threshold_px)
    : problem_(problem), threshold2_(threshold_px * threshold_px) {
  for (const Match& match : problem.matches)
    if (match.point)
      with_depth_.push_back(&match);
    else if (!with_depth_only)
      without_depth_.push_back(&match);
  const auto by_cameras = [](const Match* a, const Match* b) {
    return std::pair(a->query_camera, a->reference_camera) < std::pair(b->query_camera, b->reference_camera);
  };
  std::stable_sort(with_depth_.begin(), with_depth_.end(), by_cameras);
  std::stable_sort(without_depth_.begin(), without_depth_.end(), by_cameras);
}

void TruncatedResiduals::evaluate(const PlanarTransform& map_from_robot, Residuals& residuals) const {
  residuals.clear();
  const Rigid3 rigid = map_from_robot.rigid();
  int query_camera = -1, reference_camera = -1;
  Rigid3 camera_from_map = Rigid3::Identity();
  for (const Match* match : with_depth_) {
    const QueryCamera& query = problem_.query_cameras[static_cast<std::size_t>(match->query_camera)];
    if (std::exchange(query_camera, match->query_camera) != match->query_camera)
      camera_from_map = (rigid * query.robot_from_camera).inverse();
    const Eigen::Vector3d p = camera_from_map * match->point->point_in_map;
    residuals.emplace_back(p.z() > 0 ? Eigen::Vector2d(query.camera.project(p) - match->query_pixel)
                                     : Eigen::Vector2d(infinity, infinity));
  }
  query_camera = -1;
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  for (const Match* match : without_depth_) {
    if (match->query_camera != query_camera || match->reference_camera != reference_camera) {
      query_camera = match->query_camera;
      reference_camera = match->reference_camera;
      F = fundamentalMatrix(problem_.query_cameras[static_cast<std::size_t>(query_camera)],
                            problem_.reference_cameras[static_cast<std::size_t>(reference_camera)], rigid);
    }
    residuals.emplace_back(sampsonDistance(F, *match), 0);
  }
}

double TruncatedResiduals::truncated(const Residuals& residuals) const {
  double sum = 0;
  for (const Eigen::Vector2d& r : residuals) sum += std::min(r.squaredNorm(), threshold2_);
  return sum;
}

double TruncatedResiduals::cost(const PlanarTransform& map_from_robot) const {
  thread_local Residuals residuals;
  evaluate(map_from_robot, residuals);
  return truncated(residuals);
}

PlanarTransform TruncatedResiduals::gaussNewtonStep(const PlanarTransform& pose, const Residuals& residuals) const {
  constexpr double delta = 1e-6;  // m, rad
  std::array<Residuals, 3> ahead, behind;
  for (int k = 0; k < 3; ++k) {
    evaluate(moved(pose, delta * Eigen::Vector3d::Unit(k)), ahead[static_cast<std::size_t>(k)]);
    evaluate(moved(pose, -delta * Eigen::Vector3d::Unit(k)), behind[static_cast<std::size_t>(k)]);
  }
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!(residuals[i].squaredNorm() < threshold2_)) continue;
    Eigen::Matrix<double, 2, 3> J;
    for (std::size_t k = 0; k < 3; ++k)
      J.col(static_cast<Eigen::Index>(k)) = (ahead[k][i] - behind[k][i]) / (2 * delta);
    if (!J.allFinite()) continue;
    information += J.transpose() * J;
    gradient += J.transpose() * residuals[i];
  }
  return moved(pose, -information.ldlt().solve(gradient));
}

double TruncatedResiduals::optimize(PlanarTransform& map_from_robot) const {
  constexpr int max_steps = 10;
  Residuals residuals;
  evaluate(map_from_robot, residuals);
  double best = truncated(residuals);
  for (int i = 0; i < max_steps; ++i) {
    const PlanarTransform next = gaussNewtonStep(map_from_robot, residuals);
    evaluate(next, residuals);
    const double next_cost = truncated(residuals);
    if (!(next_cost < best)) break;
    map_from_robot = next;
    best = next_cost;
  }
  return best;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "prepared_matches.h"

namespace vmcl {
namespace {

using Vector6 = PoseRefiner::Vector6;
using Matrix6 = PoseRefiner::Matrix6;
using RowVector6 = Eigen::Matrix<double, 1, 6>;

/// The axes in the map about which phi, pitch and roll turn the robot.
struct TurnAxes {
  Eigen::Vector3d phi, roll, pitch;

  explicit TurnAxes(const RefinedPose& pose)
      : phi(Eigen::Vector3d::UnitZ()),
        roll(pose.rigid().linear() * Eigen::Vector3d::UnitX()),
        pitch(-std::sin(pose.map_from_robot.phi), std::cos(pose.map_from_robot.phi), 0) {}

  /// Derivatives over (x, y, phi, roll, pitch, height) of a quantity with the given derivative over the robot's
  /// position and moment over a turn of the robot about an axis (d = moment . axis).
  RowVector6 derivative(const Eigen::RowVector3d& by_position, const Eigen::RowVector3d& moment) const {
    RowVector6 d;
    d << by_position.x(), by_position.y(), moment * phi, moment * roll, moment * pitch, by_position.z();
    return d;
  }
};

/// Chance that a match is an inlier.
double responsibility(double likelihood_ratio, double prior) {
  return prior * likelihood_ratio / (1 - prior + prior * likelihood_ratio);
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

void SoftPlane::check() const {
  if (!std::isfinite(sigma_tilt) || sigma_tilt < 0 || sigma_tilt > 1)
    throw std::invalid_argument("sigma_tilt must be in [0, 1] rad, not " + std::to_string(sigma_tilt));
  if (!std::isfinite(sigma_height) || sigma_height < 0)
    throw std::invalid_argument("sigma_height must not be negative, not " + std::to_string(sigma_height));
}

Rigid3 RefinedPose::rigid() const {
  Rigid3 pose = Rigid3::Identity();
  pose.translation() << map_from_robot.x, map_from_robot.y, height;
  pose.linear() =
      (Eigen::AngleAxisd(map_from_robot.phi, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return pose;
}

PoseRefiner::PoseRefiner(const PoseLikelihood& likelihood, const SoftPlane& plane)
    : likelihood_(likelihood), plane_(plane) {
  plane.check();
}

double PoseRefiner::objective(const RefinedPose& pose) const {
  const auto logPrior = [](double value, double sigma) {
    return sigma > 0 ? -0.5 * value * value / (sigma * sigma) : 0;
  };
  return likelihood_(pose.rigid()) + logPrior(pose.roll, plane_.sigma_tilt) + logPrior(pose.pitch, plane_.sigma_tilt) +
         logPrior(pose.height, plane_.sigma_height);
}

PoseRefiner::Linearization PoseRefiner::linearize(const RefinedPose& pose) const {
  const auto& p = *likelihood_.prepared_;
  const Rigid3 map_from_robot = pose.rigid();
  const TurnAxes axes(pose);
  Linearization sum;
  const auto addPoint = [&](const PointView&, const PointGroup& group, std::size_t i, const PointView::Residual& r) {
    // Moving or turning the robot moves the point the other way: d pixel = -J (dt + axis x (X - t)).
    const Eigen::Matrix<double, 2, 3> by_turn =
        r.pixel_by_point * crossMatrix(group.point_in_map[i] - map_from_robot.translation());
    Eigen::Matrix<double, 2, 6> J;
    for (int row = 0; row < 2; ++row) J.row(row) = axes.derivative(-r.pixel_by_point.row(row), by_turn.row(row));
    const double weight = responsibility(r.likelihood_ratio, p.options.inlier_prior);
    sum.gradient -= weight * J.transpose() * (r.information * r.pixel_error);
    sum.information += weight * J.transpose() * r.information * J;
  };
  const auto addRay = [&](const EpipolarView& view, const RayGroup& group, std::size_t i,
                          const EpipolarView::Residual& r) {
    const Eigen::Vector3d f = view.map_from_query_pixel * group.query_pixel[i].homogeneous();
    const Eigen::Vector3d g = view.map_from_reference_pixel * group.reference_pixel[i].homogeneous();
    const Eigen::Vector3d arm = map_from_robot.linear() *
                                p.query_cameras[static_cast<std::size_t>(group.query)].robot_from_camera.translation();
    const Eigen::Vector3d by_position = g.cross(f);  // the constraint is b . (g x f)
    const Eigen::Vector3d moment = f.cross(view.baseline.cross(g)) + arm.cross(by_position);
    const RowVector6 J = axes.derivative(by_position.transpose(), moment.transpose()) / r.norm;
    const double weight = responsibility(r.likelihood_ratio, p.options.inlier_prior) / (view.sigma * view.sigma);
    sum.gradient -= weight * r.sampson * J.transpose();
    sum.information += weight * J.transpose() * J;
  };
  p.visit(map_from_robot, addPoint, addRay);
  return sum;
}

RefinedPose PoseRefiner::refine(const PlanarTransform& start, int max_iterations) const {
  Vector6 prior = Vector6::Zero();  // information of roll, pitch, height
  const bool free_tilt = plane_.sigma_tilt > 0, free_height = plane_.sigma_height > 0;
  if (free_tilt) prior[3] = prior[4] = 1 / (plane_.sigma_tilt * plane_.sigma_tilt);
  if (free_height) prior[5] = 1 / (plane_.sigma_height * plane_.sigma_height);
  const auto regularize = [&](Linearization& linear, const RefinedPose& pose) {
    for (int k = 3; k < 6; ++k) {
      if (prior[k] > 0) continue;
      linear.gradient[k] = 0;
      linear.information.row(k).setZero();
      linear.information.col(k).setZero();
      linear.information(k, k) = 1;
    }
    linear.information.diagonal() += prior;
    linear.gradient.tail<3>() -= prior.tail<3>().cwiseProduct(Eigen::Vector3d(pose.roll, pose.pitch, pose.height));
  };

  RefinedPose best;
  best.map_from_robot = start.pose();
  best.objective = objective(best);
  double damping = 1e-4;
  Linearization linear = linearize(best);
  regularize(linear, best);
  for (int i = 0; i < max_iterations && damping < 1e6; ++i) {
    Matrix6 damped = linear.information;
    damped.diagonal() += damping * linear.information.diagonal() + Vector6::Constant(1e-12);
    const Vector6 step = damped.ldlt().solve(linear.gradient);
    if (!step.allFinite()) break;
    RefinedPose next = best;
    next.map_from_robot.x += step[0];
    next.map_from_robot.y += step[1];
    next.map_from_robot.phi = wrapAngle(next.map_from_robot.phi + step[2]);
    next.roll += step[3];
    next.pitch += step[4];
    next.height += step[5];
    next.objective = objective(next);
    if (!(next.objective > best.objective)) {
      damping *= 10;
      continue;
    }
    const double gain = next.objective - best.objective;
    best = next;
    damping = std::max(damping * 0.1, 1e-9);
    linear = linearize(best);
    regularize(linear, best);
    if (gain < 1e-6) break;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(linear.information, Eigen::EigenvaluesOnly);
  best.constrained = eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[5];
  if (best.constrained) best.covariance = linear.information.inverse().topLeftCorner<3, 3>();
  return best;
}

std::vector<int> PoseRefiner::inliers(const RefinedPose& pose) const {
  const auto& p = *likelihood_.prepared_;
  const double even_ratio = (1 - p.options.inlier_prior) / p.options.inlier_prior;
  std::vector<int> result;
  const auto collect = [&](const auto&, const auto& group, std::size_t i, const auto& residual) {
    if (residual.likelihood_ratio > even_ratio) result.push_back(group.match[i]);
  };
  p.visit(pose.rigid(), collect, collect);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace vmcl

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

/// The axes in the map about which phi, pitch and roll turn the robot.
struct TurnAxes {
  Eigen::Vector3d phi, roll, pitch;

  explicit TurnAxes(const RefinedPose& pose)
      : phi(Eigen::Vector3d::UnitZ()),
        roll(pose.rigid().linear() * Eigen::Vector3d::UnitX()),
        pitch(-std::sin(pose.map_from_robot.phi), std::cos(pose.map_from_robot.phi), 0) {}
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
  const TurnAxes axes(pose);
  Linearization sum;
  p.visit(pose.rigid(), [&](int, const MatchResidual& r) {
    const Eigen::Matrix<double, 2, 3> by_turn = r.pixel_by_point * crossMatrix(r.arm);
    Eigen::Matrix<double, 2, 6> J;
    J.leftCols<2>() = -r.scale * r.pixel_by_point.leftCols<2>();
    J.col(2) = by_turn * axes.phi;
    J.col(3) = by_turn * axes.roll;
    J.col(4) = by_turn * axes.pitch;
    J.col(5) = -r.scale * r.pixel_by_point.col(2);
    const double weight = responsibility(r.likelihood_ratio, p.options.inlier_prior);
    sum.gradient -= weight * J.transpose() * (r.information * r.pixel_error);
    sum.information += weight * J.transpose() * r.information * J;
  });
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
  // Of the matrix scaled to a unit diagonal, so that neither units nor the amount of data count.
  const Vector6 scale = linear.information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 correlation = scale.asDiagonal() * linear.information * scale.asDiagonal();
  if (!correlation.allFinite()) return best;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(correlation, Eigen::EigenvaluesOnly);
  best.constrained = eigen.eigenvalues()[0] > 1e-9;
  if (best.constrained) best.covariance = linear.information.inverse().topLeftCorner<3, 3>();
  return best;
}

std::vector<int> PoseRefiner::inliers(const RefinedPose& pose) const {
  const auto& p = *likelihood_.prepared_;
  const double even_ratio = (1 - p.options.inlier_prior) / p.options.inlier_prior;
  std::vector<int> result;
  p.visit(pose.rigid(), [&](int match, const MatchResidual& residual) {
    if (residual.likelihood_ratio > even_ratio) result.push_back(match);
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace vmcl

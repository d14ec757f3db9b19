// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "prepared_matches.h"

namespace vmcl {
namespace {

using Vector6 = PoseRefiner::Vector6;
using Matrix6 = PoseRefiner::Matrix6;

const double sqrt_2pi = std::sqrt(2 * std::numbers::pi);

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

RefinedPose moved(RefinedPose pose, const Vector6& step) {
  pose.map_from_robot.x += step[0];
  pose.map_from_robot.y += step[1];
  pose.map_from_robot.phi = wrapAngle(pose.map_from_robot.phi + step[2]);
  pose.roll += step[3];
  pose.pitch += step[4];
  pose.height += step[5];
  return pose;
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
    : likelihood_(likelihood), sigma_(plane.sigma_tilt, plane.sigma_tilt, plane.sigma_height) {
  plane.check();
}

double PoseRefiner::logPrior(const RefinedPose& pose) const {
  const Eigen::Vector3d off(pose.roll, pose.pitch, pose.height);
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    if (sigma_[k] > 0) sum -= 0.5 * std::pow(off[k] / sigma_[k], 2) + std::log(sigma_[k] * sqrt_2pi);
  return sum;
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
    const Vector6 gradient = -J.transpose() * (r.information * r.pixel_error);
    sum.gradient += weight * gradient;
    sum.information += weight * J.transpose() * r.information * J;
    sum.doubt += weight * (1 - weight) * gradient * gradient.transpose();
  });
  return sum;
}

PoseRefiner::Linearization PoseRefiner::withPrior(const RefinedPose& pose) const {
  Linearization linear = linearize(pose);
  const Eigen::Vector3d off(pose.roll, pose.pitch, pose.height);
  for (int k = 0; k < 3; ++k) {
    const double precision = sigma_[k] > 0 ? 1 / (sigma_[k] * sigma_[k]) : 0;
    if (precision > 0) {
      linear.gradient[3 + k] -= precision * off[k];
      linear.information(3 + k, 3 + k) += precision;
      continue;
    }
    linear.gradient[3 + k] = 0;
    for (Matrix6* matrix : {&linear.information, &linear.doubt}) {
      matrix->row(3 + k).setZero();
      matrix->col(3 + k).setZero();
    }
    linear.information(3 + k, 3 + k) = 1;  // held: of no effect on the others
  }
  return linear;
}

RefinedPose PoseRefiner::refine(const PlanarTransform& start, int max_iterations) const {
  constexpr double near_the_top = 1e-2, at_the_top = 1e-11;  // gain of L expected from a step
  const auto evaluate = [&](RefinedPose& pose) {
    pose.log_likelihood = likelihood_(pose.rigid());
    return pose.log_likelihood + logPrior(pose);
  };
  RefinedPose best;
  best.map_from_robot = start.pose();
  double objective = evaluate(best), damping = 1e-4;
  Linearization linear = withPrior(best);
  bool near = false;  // Then the gradient leads, not L: it vanishes in one place, wherever the climb came from.
  for (int i = 0; i < max_iterations && damping < 1e6; ++i) {
    Matrix6 damped = linear.information;
    damped.diagonal() += damping * linear.information.diagonal() + Vector6::Constant(1e-12);
    const Vector6 step = damped.ldlt().solve(linear.gradient);
    if (!step.allFinite()) break;
    RefinedPose next = moved(best, step);
    const double expected_gain = 0.5 * step.dot(linear.gradient);
    near |= expected_gain < near_the_top && damping < 0.1;
    if (near) {
      best = next;
      linear = withPrior(best);
      if (expected_gain < at_the_top) break;
      continue;
    }
    const double gain = evaluate(next) - objective;
    if (!(gain > 0)) {
      damping *= 10;
      continue;
    }
    best = next;
    objective += gain;
    damping = std::max(damping * 0.1, 1e-9);
    linear = withPrior(best);
  }
  evaluate(best);
  setUncertainty(linear, best);
  return best;
}

void PoseRefiner::setUncertainty(const Linearization& linear, RefinedPose& pose) const {
  // Of the matrix scaled to a unit diagonal, so that neither units nor the amount of data count.
  const Vector6 scale = linear.information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 correlation = scale.asDiagonal() * linear.information * scale.asDiagonal();
  if (!correlation.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(correlation);
  pose.constrained = eigen.eigenvalues()[0] > 1e-9;
  if (!pose.constrained) return;
  // Less the doubt, in axes in which the information is the unit matrix.
  const Matrix6 whiten =
      scale.asDiagonal() * eigen.eigenvectors() * eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> doubt(whiten.transpose() * linear.doubt * whiten);
  constexpr double least_left = 0.2;  // of the information in any direction: the Gaussian need not be flat
  const Vector6 left = (1 - doubt.eigenvalues().array()).cwiseMax(least_left);
  const Matrix6 axes = whiten * doubt.eigenvectors();
  const Matrix6 covariance = axes * left.cwiseInverse().asDiagonal() * axes.transpose();
  pose.covariance = covariance.topLeftCorner<3, 3>();
  const auto freedom = 3 + static_cast<double>((sigma_.array() > 0).count());
  const double log_determinant = 2 * std::log(std::abs(whiten.determinant())) - left.array().log().sum();
  pose.log_evidence = pose.log_likelihood + logPrior(pose) + freedom * std::log(sqrt_2pi) + 0.5 * log_determinant;
}

double PoseRefiner::inlierRate(const RefinedPose& pose, double prior_rate) const {
  constexpr double prior_matches = 15;
  const auto& p = *likelihood_.prepared_;
  std::vector<double> ratios;
  p.visit(pose.rigid(), [&](int, const MatchResidual& residual) { ratios.push_back(residual.likelihood_ratio); });
  double rate = prior_rate;
  for (int i = 0; i < 20; ++i) {
    double inliers = prior_matches * prior_rate;
    for (const double ratio : ratios) inliers += responsibility(ratio, rate);
    rate = inliers / (prior_matches + p.matches.match_count);
  }
  return rate;
}

double PoseRefiner::sigmaPx(const RefinedPose& pose, double inlier_rate, double prior_sigma_px) const {
  constexpr double prior_coordinates = 4, pose_coordinates = 3;  // the latter fit because the pose was made to
  const auto& p = *likelihood_.prepared_;
  double fit = prior_coordinates * std::pow(prior_sigma_px / p.options.sigma_px, 2), freedom = 0;
  p.visit(pose.rigid(), [&](int, const MatchResidual& residual) {
    const double weight = responsibility(residual.likelihood_ratio, inlier_rate);
    fit += weight * residual.noise_fit;
    freedom += weight * residual.noise_freedom;
  });
  freedom = prior_coordinates + std::max(0.0, freedom - pose_coordinates);
  return p.options.sigma_px * std::sqrt(fit / freedom);
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

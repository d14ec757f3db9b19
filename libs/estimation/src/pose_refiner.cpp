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

// Gains of the objective that a step is expected to bring.
constexpr double near_the_top = 0.5, at_the_top = 1e-3;

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

/// The step to where the gradient vanishes, if the weights move with the pose: Newton's, as far as the information left
/// allows; steps with the weights held would only come nearer by the share of it that is in doubt.
Vector6 newtonStep(const PoseRefiner::Linearization& linear) {
  constexpr double longest = 5;  // gain expected over that of the step with weights held
  const Matrix6 tiny = Vector6::Constant(1e-12).asDiagonal();
  const Vector6 held = (linear.information + tiny).ldlt().solve(linear.gradient);
  const Eigen::LLT<Matrix6> left(linear.information - linear.doubt + tiny);
  if (left.info() != Eigen::Success) return held;
  const Vector6 step = left.solve(linear.gradient);
  return step.dot(linear.gradient) < longest * held.dot(linear.gradient) ? step : held;
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

RefinedPose RefinedPose::at(const Rigid3& map_from_robot) {
  const auto& R = map_from_robot.linear();
  const auto& t = map_from_robot.translation();
  RefinedPose pose;
  pose.map_from_robot = {t.x(), t.y(), std::atan2(R(1, 0), R(0, 0))};
  pose.roll = std::atan2(R(2, 1), R(2, 2));
  pose.pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  pose.height = t.z();
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
  LogLikelihoodSum log_likelihood(p.options.inlier_prior, p.outlier_sum);
  p.visit(pose.rigid(), [&](int, const MatchResidual& r) {
    log_likelihood.add(r.likelihood_ratio);
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
  sum.log_likelihood = log_likelihood.total();
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

RefinedPose PoseRefiner::refine(const PlanarTransform& start) const {
  RefinedPose pose;
  pose.map_from_robot = start.pose();
  return refine(pose);
}

RefinedPose PoseRefiner::refine(const RefinedPose& start) const {
  const Position top = settled(climbed(at(start), near_the_top));
  RefinedPose pose = top.pose;
  pose.log_likelihood = top.linear.log_likelihood;
  setUncertainty(top.linear, pose);
  return pose;
}

PoseRefiner::Position PoseRefiner::at(const RefinedPose& pose) const {
  Position position{pose, withPrior(pose)};
  position.objective = position.linear.log_likelihood + logPrior(pose);
  return position;
}

PoseRefiner::Position PoseRefiner::climbed(Position best, double near) const {
  constexpr int max_steps = 20;
  double damping = 1e-4;
  for (int i = 0; i < max_steps && damping < 1e6; ++i) {
    Matrix6 damped = best.linear.information;
    damped.diagonal() += damping * best.linear.information.diagonal() + Vector6::Constant(1e-12);
    const Vector6 step = damped.ldlt().solve(best.linear.gradient);
    if (!step.allFinite()) break;
    if (damping < 0.1 && 0.5 * step.dot(best.linear.gradient) < near) break;
    const Position next = at(moved(best.pose, step));
    const bool is_higher = next.objective > best.objective;
    damping = is_higher ? std::max(damping * 0.1, 1e-9) : damping * 10;
    if (is_higher) best = next;
  }
  return best;
}

PoseRefiner::Position PoseRefiner::settled(const Position& top) const {
  constexpr int max_steps = 15;
  constexpr double settled = 1e-11;  // gain expected from a step
  constexpr double most_lost = 0.1;  // of the objective
  Position best = top;
  for (int i = 0; i < max_steps; ++i) {
    const Vector6 step = newtonStep(best.linear);
    if (!step.allFinite()) break;
    const Position next = at(moved(best.pose, step));
    if (!(next.objective > top.objective - most_lost)) break;
    const double expected_gain = 0.5 * step.dot(best.linear.gradient);
    best = next;
    if (expected_gain < settled) return best;
  }
  return climbed(top, at_the_top);
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
  constexpr int halvings = 30;
  const auto& p = *likelihood_.prepared_;
  std::vector<double> ratios;
  p.visit(pose.rigid(), [&](int, const MatchResidual& residual) { ratios.push_back(residual.likelihood_ratio); });
  // The slope of the log likelihood over the rate's log odds: inliers as they show, less those that the rate expects.
  const auto slope = [&](double rate) {
    double sum = prior_matches * (prior_rate - rate);
    for (const double ratio : ratios) sum += responsibility(ratio, rate);
    for (const double odds : p.inlier_odds) sum -= responsibility(odds, rate);
    if (p.inlier_odds.empty()) sum -= p.matches.match_count * rate;
    return sum;
  };
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (slope(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

PixelNoise PoseRefiner::pixelNoise(const RefinedPose& pose, double inlier_rate, double prior_sigma_px) const {
  constexpr double prior_coordinates = 4, pose_coordinates = 3;  // the latter fit because the pose was made to
  const auto& p = *likelihood_.prepared_;
  double fit = prior_coordinates * std::pow(prior_sigma_px / p.options.sigma_px, 2), freedom = 0;
  p.visit(pose.rigid(), [&](int, const MatchResidual& residual) {
    const double weight = responsibility(residual.likelihood_ratio, inlier_rate);
    fit += weight * residual.noise_fit;
    freedom += weight * residual.noise_freedom;
  });
  freedom = prior_coordinates + std::max(0.0, freedom - pose_coordinates);
  return {p.options.sigma_px * std::sqrt(fit / freedom), freedom};
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

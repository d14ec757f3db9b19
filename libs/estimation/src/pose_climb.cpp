// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "best_distinct.h"
#include "prepared_matches.h"
#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/estimation/pose_refiner.h"

namespace vmcl {
namespace {

/// Levenberg-Marquardt at one pose, the likelihood evaluated by others.
class Climb {
 public:
  Climb(const PlanarTransform& pose, const PlanarSlope& slope, int start) : reached_{pose, slope, start} {}

  bool isOver() const { return is_over_; }

  PlanarTransform next() {
    const auto& [pose, slope, start] = reached_;
    Eigen::Matrix3d damped = slope.information;
    damped.diagonal() += damping_ * slope.information.diagonal() + Eigen::Vector3d::Constant(1e-12);
    const Eigen::Vector3d step = damped.ldlt().solve(slope.gradient);
    if (!step.allFinite()) return pose;
    expected_gain_ = 0.5 * step.dot(slope.gradient);
    const double c = std::cos(step[2]), s = std::sin(step[2]);
    const PlanarTransform moved(pose.c * c - pose.s * s, pose.s * c + pose.c * s, pose.x + step[0], pose.y + step[1]);
    const double norm = std::sqrt(moved.c * moved.c + moved.s * moved.s);
    return {moved.c / norm, moved.s / norm, moved.x, moved.y};
  }

  /// Takes the step to `pose`, where L is as `slope` says, if it leads up. All but at the top the slope may point
  /// beyond the top of L, since it leaves a part of L out.
  void take(const PlanarTransform& pose, const PlanarSlope& slope) {
    constexpr double worthwhile = 0.05, hopeless_damping = 1e3;
    if (slope.log_likelihood > reached_.slope.log_likelihood) {
      reached_.map_from_robot = pose;
      reached_.slope = slope;
      damping_ *= 0.1;
    } else {
      damping_ *= 10;
    }
    is_over_ = damping_ > hopeless_damping || (expected_gain_ < worthwhile && damping_ < 0.1);
  }

  const ClimbedPose& reached() const { return reached_; }

 private:
  ClimbedPose reached_;
  double damping_ = 1e-3;
  double expected_gain_ = 0;
  bool is_over_ = false;
};

/// The highest first, without those that met a higher one.
std::vector<Climb> withoutMet(const std::vector<Climb>& climbs) {
  constexpr double met_distance2 = 0.1;  // in standard deviations, m and rad
  std::vector<double> heights;
  std::vector<PlanarPose> poses;
  for (const Climb& climb : climbs) {
    heights.push_back(climb.reached().slope.log_likelihood);
    poses.push_back(climb.reached().map_from_robot.pose());
  }
  const auto met = [&](std::size_t one, std::size_t other) {
    const Eigen::Vector3d d = difference(poses[one], poses[other]);
    return d.squaredNorm() + d.dot(climbs[other].reached().slope.information * d) < met_distance2;
  };
  std::vector<Climb> kept;
  for (const std::size_t i : bestDistinct(heights, climbs.size(), met)) kept.push_back(climbs[i]);
  return kept;
}

}  // namespace

void PoseRefiner::linearize(std::span<const PlanarTransform> poses, std::span<PlanarSlope> slopes) const {
  if (poses.size() != slopes.size())
    throw std::invalid_argument("PoseRefiner::linearize: " + std::to_string(poses.size()) + " poses but " +
                                std::to_string(slopes.size()) + " results");
  const auto& terms = likelihood_.prepared_->terms();
  if (terms) linearizeTerms(*terms, poses, slopes);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (terms && isWithinReach(*terms, poses[i])) continue;
    RefinedPose pose;
    pose.map_from_robot = poses[i].pose();
    const Linearization linear = linearize(pose);
    slopes[i] = {likelihood_(poses[i]), linear.gradient.head<3>(), linear.information.topLeftCorner<3, 3>()};
  }
}

std::vector<ClimbedPose> PoseRefiner::climb(std::span<const PlanarTransform> starts) const {
  constexpr int max_steps = 15;
  std::vector<PlanarTransform> poses(starts.begin(), starts.end());
  std::vector<PlanarSlope> slopes(starts.size());
  linearize(poses, slopes);
  std::vector<Climb> climbs;
  for (std::size_t i = 0; i < starts.size(); ++i) climbs.emplace_back(starts[i], slopes[i], static_cast<int>(i));
  std::vector<Climb*> going;
  for (int step = 0; step < max_steps; ++step) {
    going.clear();
    for (Climb& climb : climbs)
      if (!climb.isOver()) going.push_back(&climb);
    if (going.empty()) break;
    poses.clear();
    for (Climb* climb : going) poses.push_back(climb->next());
    linearize(poses, std::span(slopes).first(poses.size()));
    for (std::size_t i = 0; i < going.size(); ++i) going[i]->take(poses[i], slopes[i]);
    climbs = withoutMet(climbs);
  }
  std::vector<ClimbedPose> reached;
  for (const Climb& climb : climbs) reached.push_back(climb.reached());
  return reached;
}

}  // namespace vmcl

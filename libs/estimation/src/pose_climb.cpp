// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "prepared_matches.h"
#include "vmcl/estimation/pose_refiner.h"

namespace vmcl {
namespace {

/// Levenberg-Marquardt at one pose, the likelihood evaluated by others.
class Climb {
 public:
  Climb(const PlanarTransform& start, const PlanarSlope& slope) : pose_(start), slope_(slope) {}

  bool isOver() const { return is_over_; }

  PlanarTransform next() const {
    Eigen::Matrix3d damped = slope_.information;
    damped.diagonal() += damping_ * slope_.information.diagonal() + Eigen::Vector3d::Constant(1e-12);
    const Eigen::Vector3d step = damped.ldlt().solve(slope_.gradient);
    if (!step.allFinite()) return pose_;
    const double c = std::cos(step[2]), s = std::sin(step[2]);
    const PlanarTransform moved(pose_.c * c - pose_.s * s, pose_.s * c + pose_.c * s, pose_.x + step[0],
                                pose_.y + step[1]);
    const double norm = std::hypot(moved.c, moved.s);
    return {moved.c / norm, moved.s / norm, moved.x, moved.y};
  }

  /// Takes the step to `pose`, where L is as `slope` says, if it leads up.
  void take(const PlanarTransform& pose, const PlanarSlope& slope) {
    constexpr double worthwhile = 0.01, hopeless_damping = 1e3;
    const double gain = slope.log_likelihood - slope_.log_likelihood;
    if (gain > 0) {
      pose_ = pose;
      slope_ = slope;
      damping_ *= 0.1;
      is_over_ = gain < worthwhile && damping_ < 1e-2;
    } else {
      damping_ *= 10;
      is_over_ = damping_ > hopeless_damping;
    }
  }

  ClimbedPose reached() const { return {pose_, slope_}; }

 private:
  PlanarTransform pose_;
  PlanarSlope slope_;
  double damping_ = 1e-3;
  bool is_over_ = false;
};

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

std::vector<ClimbedPose> PoseRefiner::climb(std::span<const PlanarTransform> starts, int max_steps) const {
  std::vector<PlanarTransform> poses(starts.begin(), starts.end());
  std::vector<PlanarSlope> slopes(starts.size());
  linearize(poses, slopes);
  std::vector<Climb> climbs;
  for (std::size_t i = 0; i < starts.size(); ++i) climbs.emplace_back(starts[i], slopes[i]);
  std::vector<Climb*> going;
  for (int step = 0; step < max_steps; ++step) {
    going.clear();
    for (Climb& climb : climbs)
      if (!climb.isOver()) going.push_back(&climb);
    if (going.empty()) break;
    poses.clear();
    for (const Climb* climb : going) poses.push_back(climb->next());
    linearize(poses, std::span(slopes).first(poses.size()));
    for (std::size_t i = 0; i < going.size(); ++i) going[i]->take(poses[i], slopes[i]);
  }
  std::vector<ClimbedPose> reached;
  for (const Climb& climb : climbs) reached.push_back(climb.reached());
  return reached;
}

}  // namespace vmcl

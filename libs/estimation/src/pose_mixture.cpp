// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/pose_mixture.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vmcl {

std::string_view nameOf(Solver solver) {
  switch (solver) {
    case Solver::one_point_one_depth:
      return "1p1dp";
    case Solver::two_depth:
      return "2dp";
    case Solver::automatic:
      break;
  }
  return "auto";
}

Eigen::Vector3d difference(const PlanarPose& b, const PlanarPose& a) {
  return {b.x - a.x, b.y - a.y, wrapAngle(b.phi - a.phi)};
}

namespace {

bool within3Sigma(const PoseMode& mode, const PlanarPose& pose) {
  const Eigen::Vector3d d = difference(pose, mode.robot_in_map);
  return d.dot(mode.covariance.ldlt().solve(d)) < 9;
}

}  // namespace

std::vector<PoseMode> mergeModes(std::vector<PoseMode> modes, int max_modes) {
  std::stable_sort(modes.begin(), modes.end(),
                   [](const PoseMode& a, const PoseMode& b) { return a.log_likelihood > b.log_likelihood; });
  std::vector<PoseMode> kept;
  for (PoseMode& mode : modes) {
    const bool seen = std::any_of(kept.begin(), kept.end(), [&](const PoseMode& better) {
      return within3Sigma(better, mode.robot_in_map) || within3Sigma(mode, better.robot_in_map);
    });
    if (seen) continue;
    mode.log_weight = mode.log_likelihood + 0.5 * std::log(mode.covariance.determinant());
    kept.push_back(std::move(mode));
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const PoseMode& a, const PoseMode& b) { return a.log_weight > b.log_weight; });
  if (static_cast<int>(kept.size()) > max_modes) kept.resize(static_cast<std::size_t>(max_modes));
  if (kept.empty()) return kept;
  double sum = 0;
  for (const PoseMode& mode : kept) sum += std::exp(mode.log_weight - kept.front().log_weight);
  const double normalizer = kept.front().log_weight + std::log(sum);
  for (PoseMode& mode : kept) mode.log_weight -= normalizer;
  return kept;
}

}  // namespace vmcl

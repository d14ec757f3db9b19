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
    case Solver::three_rays:
      return "3p";
    case Solver::three_bearings:
      return "3b";
    case Solver::three_depth:
      return "3dp";
    case Solver::automatic:
      break;
  }
  return "auto";
}

Eigen::Vector3d difference(const PlanarPose& b, const PlanarPose& a) {
  return {b.x - a.x, b.y - a.y, wrapAngle(b.phi - a.phi)};
}

namespace {

/// Squared distance in standard deviations of whichever is the less certain.
double distance2(const PoseMode& a, const PoseMode& b) {
  const Eigen::Vector3d d = difference(b.robot_in_map, a.robot_in_map);
  return std::min(d.dot(a.covariance.ldlt().solve(d)), d.dot(b.covariance.ldlt().solve(d)));
}

bool isAsFarOffThePlane(const PoseMode& a, const PoseMode& b) {
  constexpr double same_angle = 0.03, same_height = 0.1;  // rad, m
  return std::abs(wrapAngle(a.roll - b.roll)) < same_angle && std::abs(a.pitch - b.pitch) < same_angle &&
         std::abs(a.height - b.height) < same_height;
}

bool isSamePeak(const PoseMode& a, const PoseMode& b) { return distance2(a, b) < 0.25 && isAsFarOffThePlane(a, b); }

bool isSamePlace(const PoseMode& a, const PoseMode& b) {
  const Eigen::Vector3d d = difference(b.robot_in_map, a.robot_in_map);
  return isAsFarOffThePlane(a, b) && (distance2(a, b) < 9 || (d.head<2>().norm() < 0.1 && std::abs(d.z()) < 0.03));
}

/// One mode with the evidence, mean and covariance of several peaks, the heaviest first.
PoseMode joined(const std::vector<PoseMode>& peaks) {
  PoseMode all = peaks.front();
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  for (const PoseMode& peak : peaks) {
    const double weight = std::exp(peak.log_evidence - all.log_evidence);
    const Eigen::Vector3d d = difference(peak.robot_in_map, all.robot_in_map);
    sum += weight;
    mean += weight * d;
    second_moment += weight * (peak.covariance + d * d.transpose());
  }
  mean /= sum;
  all.covariance = second_moment / sum - mean * mean.transpose();
  all.robot_in_map = {all.robot_in_map.x + mean.x(), all.robot_in_map.y + mean.y(),
                      wrapAngle(all.robot_in_map.phi + mean.z())};
  all.log_evidence += std::log(sum);
  return all;
}

}  // namespace

std::vector<PoseMode> mergeModes(std::vector<PoseMode> modes, int max_modes) {
  std::stable_sort(modes.begin(), modes.end(),
                   [](const PoseMode& a, const PoseMode& b) { return a.log_evidence > b.log_evidence; });
  std::vector<std::vector<PoseMode>> places;
  for (PoseMode& mode : modes) {
    const auto place = std::find_if(places.begin(), places.end(), [&](const std::vector<PoseMode>& peaks) {
      return isSamePlace(peaks.front(), mode);
    });
    if (place == places.end())
      places.push_back({std::move(mode)});
    else if (std::none_of(place->begin(), place->end(), [&](const PoseMode& peak) { return isSamePeak(peak, mode); }))
      place->push_back(std::move(mode));
  }
  std::vector<PoseMode> kept;
  for (const std::vector<PoseMode>& peaks : places) {
    kept.push_back(joined(peaks));
    kept.back().log_weight = kept.back().log_evidence;
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

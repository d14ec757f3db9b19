// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/observation_verdict.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vmcl {
namespace {

constexpr double better_than_chance = 2, better_elsewhere = 3;  // log odds
constexpr double elsewhere_position = 0.5;                      // m
constexpr double elsewhere_heading = 15 * degree;               // rad
constexpr int compared = 100, few_better = 1, many_better = 10;

bool isElsewhere(const PlanarPose& a, const PlanarPose& b) {
  const Eigen::Vector3d apart = difference(a, b);
  return apart.head<2>().norm() > elsewhere_position || std::abs(apart.z()) > elsewhere_heading;
}

}  // namespace

Verdict judgeImage(const RelocalizingMap& map, const mrpt::obs::CObservation& observation,
                   std::span<const PoseMode> modes, const PlanarPose& robot_in_map) {
  std::vector<PlanarPose> poses{robot_in_map};
  for (const PoseMode& mode : modes) poses.push_back(mode.robot_in_map);
  std::vector<double> likelihoods(poses.size());
  map.addLogLikelihoods(observation, poses, 1, likelihoods);
  const double here = likelihoods.front();
  const auto best = std::max_element(likelihoods.begin(), likelihoods.end());
  const bool better_at_mode = *best - here > better_elsewhere;
  if (here > better_than_chance && !better_at_mode) return Verdict::agrees;
  const bool elsewhere = isElsewhere(poses[static_cast<std::size_t>(best - likelihoods.begin())], robot_in_map);
  return better_at_mode && elsewhere && *best > better_than_chance ? Verdict::contradicts : Verdict::silent;
}

Verdict judgeByRank(const mrpt::maps::CMetricMap& map, const mrpt::obs::CObservation& observation,
                    const PoseRegion& anywhere, const PlanarPose& robot_in_map, Random& random) {
  if (anywhere.volume() == 0) return Verdict::untestable;
  const auto likelihood = [&](const PlanarPose& pose) {
    return map.computeObservationLikelihood(
        observation, mrpt::poses::CPose3D(mrpt::math::TPose3D(pose.x, pose.y, 0, pose.phi, 0, 0)));
  };
  const double here = likelihood(robot_in_map);
  int better = 0, different = 0;
  for (int i = 0; i < compared; ++i) {
    const double there = likelihood(anywhere.draw(random));
    better += there > here;
    different += there != here;
  }
  if (different == 0) return Verdict::untestable;
  return better <= few_better ? Verdict::agrees : better < many_better ? Verdict::silent : Verdict::contradicts;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/relative_error.h"

#include <cmath>

namespace vmcl {
namespace {

struct Pair {
  PlanarPose estimate;
  PlanarPose truth;
  double time = 0;
};

}  // namespace

RelativeError relativeError(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth, double interval,
                            double max_gap) {
  std::vector<Pair> poses;
  for (const TimedEstimate& estimate : estimates) {
    if (!estimate.localized) continue;
    if (const auto truth = ground_truth.at(estimate.time, max_gap))
      poses.push_back({estimate.robot_in_map, planarPart(*truth), estimate.time});
  }
  RelativeError error;
  std::size_t later = 0;
  for (const Pair& from : poses) {
    while (later < poses.size() && poses[later].time < from.time + interval) ++later;
    if (later == poses.size()) break;
    const Pair& to = poses[later];
    if (to.time >= from.time + 1.5 * interval) continue;
    const PlanarPose estimated = inverse(from.estimate) * to.estimate, moved = inverse(from.truth) * to.truth;
    const PlanarPose difference = inverse(moved) * estimated;
    ++error.pairs;
    error.position += difference.x * difference.x + difference.y * difference.y;
    error.heading += difference.phi * difference.phi;
  }
  if (error.pairs == 0) return error;
  error.position = std::sqrt(error.position / error.pairs);
  error.heading = std::sqrt(error.heading / error.pairs);
  return error;
}

}  // namespace vmcl

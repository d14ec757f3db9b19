// SPDX-License-Identifier: BSD-3-Clause
#include "inverse_depth_prior.h"

#include <cmath>

namespace vmcl {

InverseDepthPrior inverseDepthPrior(const PoseProblem& problem) {
  constexpr double nearest = 0.2;  // m; nearer points would outweigh all others
  const InverseDepthPrior room;
  double count = 2;
  double sum = count * room.mean;
  double sum_of_squares = count * (room.mean * room.mean + room.sigma * room.sigma);
  for (const Match& match : problem.matches) {
    if (!match.point) continue;
    const Rigid3& map_from_camera =
        problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)].map_from_camera;
    const double depth = map_from_camera.linear().col(2).dot(match.point->point_in_map - map_from_camera.translation());
    if (!(depth > nearest)) continue;
    count += 1;
    sum += 1 / depth;
    sum_of_squares += 1 / (depth * depth);
  }
  const double mean = sum / count;
  return {mean, std::sqrt(sum_of_squares / count - mean * mean)};
}

}  // namespace vmcl

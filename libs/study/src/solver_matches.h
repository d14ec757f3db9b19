// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vmcl/estimation/match_rays.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// The matches as the minimal solvers want them.
struct SolverMatches {
  std::vector<RayToRay> all;
  std::vector<RayToPoint> with_depth;
  std::vector<uint32_t> index_of_depth;  ///< in `all`

  explicit SolverMatches(const PoseProblem& problem) {
    for (const Match& match : problem.matches) {
      const RayToRay rays = raysOfMatch(problem, match);
      if (match.point) {
        index_of_depth.push_back(static_cast<uint32_t>(all.size()));
        with_depth.push_back({rays.ray_in_robot, match.point->point_in_map});
      }
      all.push_back(rays);
    }
  }
};

/// A number below `count`, but not `taken`.
inline uint32_t drawAnother(uint32_t count, uint32_t taken, Random& random) {
  const uint32_t drawn = random.below(count - 1);
  return drawn < taken ? drawn : drawn + 1;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/sample_success.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "solver_matches.h"
#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {

double sampleSuccess(Solver solver, const PoseProblem& problem, const PlanarPose& map_from_robot, int samples,
                     uint64_t seed, const Tolerance& tolerance) {
  const SolverMatches matches(problem);
  const auto all = static_cast<uint32_t>(matches.all.size()), deep = static_cast<uint32_t>(matches.with_depth.size());
  const auto isNear = [&](const PlanarTransform& found) { return tolerance.holds(found, map_from_robot); };
  Random random(seed);
  int successes = 0;
  if (solver == Solver::one_point_one_depth) {
    for (int i = 0; i < samples && deep > 0 && all > 1; ++i) {
      const uint32_t depth = random.below(deep), other = drawAnother(all, matches.index_of_depth[depth], random);
      const PlanarRoots found = solveOnePointOneDepth(matches.with_depth[depth], matches.all[other]);
      successes += (found.count > 0 && isNear(found.roots[0])) || (found.count > 1 && isNear(found.roots[1]));
    }
  } else if (solver == Solver::two_depth) {
    for (int i = 0; i < samples && deep > 1; ++i) {
      const uint32_t first = random.below(deep), second = drawAnother(deep, first, random);
      const auto found = solveDepthPoints(std::array{matches.with_depth[first], matches.with_depth[second]});
      successes += found && isNear(*found);
    }
  } else {
    throw std::invalid_argument("solver must be 1p1dp or 2dp, not " + std::string(nameOf(solver)));
  }
  return static_cast<double>(successes) / samples;
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <limits>

#include "peers.h"
#include "solver_matches.h"
#include "truncated_residuals.h"
#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {
namespace {

/// The best pose so far.
class BestPose {
 public:
  explicit BestPose(const TruncatedResiduals& residuals) : residuals_(residuals) {}

  /// Takes and optimizes the candidate if it is better than what is there.
  void offer(PlanarTransform candidate) {
    if (!(residuals_.cost(candidate) < cost_)) return;
    cost_ = residuals_.optimize(candidate);
    pose_ = candidate;
  }

  std::vector<PlanarPose> result() const {
    return std::isfinite(cost_) ? std::vector{pose_.pose()} : std::vector<PlanarPose>{};
  }

 private:
  const TruncatedResiduals& residuals_;
  PlanarTransform pose_;
  double cost_ = std::numeric_limits<double>::infinity();
};

std::vector<PlanarPose> onePointOneDepthCounting(const PoseProblem& problem, const MethodSettings& settings) {
  const SolverMatches matches(problem);
  if (matches.with_depth.empty() || matches.all.size() < 2) return {};
  const TruncatedResiduals residuals(problem, false, settings.threshold_px);
  BestPose best(residuals);
  Random random(settings.seed);
  for (int i = 0; i < settings.iterations; ++i) {
    const uint32_t depth = random.below(static_cast<uint32_t>(matches.with_depth.size()));
    const uint32_t other =
        drawAnother(static_cast<uint32_t>(matches.all.size()), matches.index_of_depth[depth], random);
    const PlanarRoots roots = solveOnePointOneDepth(matches.with_depth[depth], matches.all[other]);
    for (int k = 0; k < roots.count; ++k) best.offer(roots.roots[static_cast<std::size_t>(k)]);
  }
  return best.result();
}

std::vector<PlanarPose> twoDepthCounting(const PoseProblem& problem, const MethodSettings& settings) {
  const SolverMatches matches(problem);
  const auto count = static_cast<uint32_t>(matches.with_depth.size());
  if (count < 2) return {};
  const TruncatedResiduals residuals(problem, true, settings.threshold_px);
  BestPose best(residuals);
  Random random(settings.seed);
  for (int i = 0; i < settings.iterations; ++i) {
    const uint32_t first = random.below(count), second = drawAnother(count, first, random);
    const std::array<RayToPoint, 2> sample{matches.with_depth[first], matches.with_depth[second]};
    if (const auto pose = solveDepthPoints(sample)) best.offer(*pose);
  }
  return best.result();
}

}  // namespace

std::vector<PoseMethod> inlierCountingMethods() {
  return {{"1P1DP", "the paper's 1P1DP (MC1P1DP for rigs): most inliers, local optimization; uses all matches", true,
           onePointOneDepthCounting},
          {"2DP", "the paper's 2DP (MC2DP for rigs): most inliers, local optimization; uses the matches with depth",
           true, twoDepthCounting}};
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "minimal_sampler.h"

#include <algorithm>
#include <array>

#include "three_rays.h"
#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/match_rays.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {

MinimalSampler::MinimalSampler(const PoseProblem& problem) {
  for (const Match& match : problem.matches) {
    const RayToRay rays = raysOfMatch(problem, match);
    if (match.point) {
      with_depth_.push_back({rays.ray_in_robot, match.point->point_in_map});
      match_of_depth_.push_back(static_cast<int>(rays_.size()));
    }
    rays_.push_back(rays);
    const auto apart = [](const Ray& a, const Ray& b) { return (a.origin - b.origin).norm() > 0.01; };
    has_baseline_ |=
        apart(rays.ray_in_map, rays_.front().ray_in_map) || apart(rays.ray_in_robot, rays_.front().ray_in_robot);
  }
}

bool MinimalSampler::canDraw(Solver kind) const {
  switch (kind) {
    case Solver::one_point_one_depth:
      return !with_depth_.empty() && rays_.size() > 1;
    case Solver::two_depth:
      return with_depth_.size() > 1;
    case Solver::three_rays:
      return rays_.size() > 2 && has_baseline_;
    case Solver::automatic:
      break;
  }
  return false;
}

double MinimalSampler::sampleCount(Solver kind) const {
  const auto n = static_cast<double>(rays_.size()), d = static_cast<double>(with_depth_.size());
  if (kind == Solver::two_depth) return d * (d - 1) / 2;
  return kind == Solver::three_rays ? n * (n - 1) * (n - 2) / 6 : d * (n - 1);
}

double MinimalSampler::chanceOfInliers(Solver kind, const std::vector<int>& inliers) const {
  std::size_t depth = 0;
  for (const int match : match_of_depth_) depth += std::binary_search(inliers.begin(), inliers.end(), match);
  const double any = double(inliers.size()) / double(rays_.size());
  const double deep = with_depth_.empty() ? 0 : double(depth) / double(with_depth_.size());
  if (kind == Solver::two_depth) return deep * deep;
  return kind == Solver::three_rays ? any * any * any : deep * any;
}

void MinimalSampler::draw(Solver kind, int count, Random& random, std::vector<PlanarTransform>& poses) const {
  if (kind == Solver::one_point_one_depth) drawOnePointOneDepth(count, random, poses);
  if (kind == Solver::two_depth) drawTwoDepth(count, random, poses);
  if (kind == Solver::three_rays) drawThreeRays(count, random, poses);
}

void MinimalSampler::drawOnePointOneDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const {
  const auto add = [&](std::size_t depth, std::size_t other) {
    if (other >= static_cast<std::size_t>(match_of_depth_[depth])) ++other;
    const PlanarRoots roots = solveOnePointOneDepth(with_depth_[depth], rays_[other]);
    poses.insert(poses.end(), roots.roots.begin(), roots.roots.begin() + roots.count);
  };
  const std::size_t n = with_depth_.size(), others = rays_.size() - 1;
  if (n * others <= static_cast<std::size_t>(count)) {
    for (std::size_t depth = 0; depth < n; ++depth)
      for (std::size_t other = 0; other < others; ++other) add(depth, other);
    return;
  }
  for (int i = 0; i < count; ++i) {
    const uint32_t depth = random.below(static_cast<uint32_t>(n));
    add(depth, random.below(static_cast<uint32_t>(others)));
  }
}

void MinimalSampler::drawTwoDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const {
  const auto add = [&](std::size_t first, std::size_t second) {
    const std::array<RayToPoint, 2> pair{with_depth_[first], with_depth_[second]};
    if (const auto pose = solveDepthPoints(pair)) poses.push_back(*pose);
  };
  const std::size_t n = with_depth_.size();
  if (n * (n - 1) / 2 <= static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k) add(i, k);
    return;
  }
  for (int i = 0; i < count; ++i) {
    const uint32_t first = random.below(static_cast<uint32_t>(n));
    uint32_t second = random.below(static_cast<uint32_t>(n - 1));
    if (second >= first) ++second;
    add(first, second);
  }
}

void MinimalSampler::drawThreeRays(int count, Random& random, std::vector<PlanarTransform>& poses) const {
  const auto any = [&] { return random.below(static_cast<uint32_t>(rays_.size())); };
  for (int i = 0; i < count; ++i) {
    const uint32_t a = any();
    uint32_t b = any(), c = any();
    while (b == a) b = any();
    while (c == a || c == b) c = any();
    const std::vector<PlanarTransform> found = solveThreeRays({rays_[a], rays_[b], rays_[c]});
    poses.insert(poses.end(), found.begin(), found.end());
  }
}

}  // namespace vmcl

// SPDX-License-Identifier: BSD-3-Clause
#include "minimal_sampler.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "three_rays.h"
#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/match_rays.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {
namespace {

// Samples are numbered in the combinatorial number system.
uint64_t pairsOf(uint64_t n) { return n * (n - 1) / 2; }
uint64_t triplesOf(uint64_t n) { return n < 3 ? 0 : n * (n - 1) / 2 * (n - 2) / 3; }

/// Largest n of which there are no more combinations than `number`.
template <class CombinationsOf>
uint64_t largestOf(uint64_t number, CombinationsOf&& combinations_of) {
  uint64_t high = 1;
  while (combinations_of(high) <= number) high *= 2;
  uint64_t low = high / 2;
  while (high - low > 1) {
    const uint64_t middle = (low + high) / 2;
    (combinations_of(middle) <= number ? low : high) = middle;
  }
  return low;
}

}  // namespace

MinimalSampler::MinimalSampler(const PoseProblem& problem, uint64_t seed) : random_(seed) {
  std::vector<std::size_t> order(problem.matches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random_.below(static_cast<uint32_t>(i))]);
  for (const std::size_t index : order) {
    const Match& match = problem.matches[index];
    const RayToRay rays = raysOfMatch(problem, match);
    if (match.point) {
      with_depth_.push_back({rays.ray_in_robot, match.point->point_in_map});
      ray_of_depth_.push_back(rays_.size());
      match_of_depth_.push_back(static_cast<int>(index));
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
  constexpr double many = 0x1p53;  // integers up to here are exact
  const auto n = static_cast<double>(rays_.size()), d = static_cast<double>(with_depth_.size());
  if (kind == Solver::two_depth) return std::min(d * (d - 1) / 2, many);
  return std::min(kind == Solver::three_rays ? n * (n - 1) * (n - 2) / 6 : d * (n - 1), many);
}

double MinimalSampler::chanceOfInliers(Solver kind, const std::vector<int>& inliers) const {
  std::size_t depth = 0;
  for (const int match : match_of_depth_) depth += std::binary_search(inliers.begin(), inliers.end(), match);
  const double any = double(inliers.size()) / double(rays_.size());
  const double deep = with_depth_.empty() ? 0 : double(depth) / double(with_depth_.size());
  if (kind == Solver::two_depth) return deep * deep;
  return kind == Solver::three_rays ? any * any * any : deep * any;
}

void MinimalSampler::draw(Solver kind, int count, std::vector<PlanarTransform>& poses) {
  EvenOrder& order = orders_.try_emplace(kind, static_cast<uint64_t>(sampleCount(kind)), random_).first->second;
  for (int i = 0; i < count; ++i) {
    const uint64_t sample = order.next();
    if (kind == Solver::one_point_one_depth) addOnePointOneDepth(sample, poses);
    if (kind == Solver::two_depth) addTwoDepth(sample, poses);
    if (kind == Solver::three_rays) addThreeRays(sample, poses);
  }
}

void MinimalSampler::addOnePointOneDepth(uint64_t sample, std::vector<PlanarTransform>& poses) const {
  const std::size_t depth = sample / (rays_.size() - 1);
  std::size_t other = sample % (rays_.size() - 1);
  if (other >= ray_of_depth_[depth]) ++other;
  const PlanarRoots roots = solveOnePointOneDepth(with_depth_[depth], rays_[other]);
  poses.insert(poses.end(), roots.roots.begin(), roots.roots.begin() + roots.count);
}

void MinimalSampler::addTwoDepth(uint64_t sample, std::vector<PlanarTransform>& poses) const {
  const uint64_t second = largestOf(sample, pairsOf);
  const std::array<RayToPoint, 2> pair{with_depth_[sample - pairsOf(second)], with_depth_[second]};
  if (const auto pose = solveDepthPoints(pair)) poses.push_back(*pose);
}

void MinimalSampler::addThreeRays(uint64_t sample, std::vector<PlanarTransform>& poses) const {
  const uint64_t third = largestOf(sample, triplesOf);
  sample -= triplesOf(third);
  const uint64_t second = largestOf(sample, pairsOf);
  const std::vector<PlanarTransform> found =
      solveThreeRays({rays_[sample - pairsOf(second)], rays_[second], rays_[third]});
  poses.insert(poses.end(), found.begin(), found.end());
}

}  // namespace vmcl

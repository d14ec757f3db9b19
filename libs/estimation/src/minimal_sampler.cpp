// SPDX-License-Identifier: BSD-3-Clause
#include "minimal_sampler.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "three_bearings.h"
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

MinimalSampler::MinimalSampler(const PoseProblem& problem, double inlier_prior, uint64_t seed) : random_(seed) {
  std::vector<std::size_t> order(problem.matches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random_.below(static_cast<uint32_t>(i))]);
  const double odds = inlier_prior / (1 - inlier_prior);
  for (const std::size_t index : order) {
    const Match& match = problem.matches[index];
    const RayToRay rays = raysOfMatch(problem, match);
    const double chance = odds * match.inlier_odds / (1 + odds * match.inlier_odds);
    if (match.point) {
      with_depth_.push_back({rays.ray_in_robot, match.point->point_in_map});
      ray_of_depth_.push_back(rays_.size());
      depth_chances_.add(chance);
    }
    rays_.push_back(rays);
    match_of_ray_.push_back(static_cast<int>(index));
    ray_chances_.add(chance);
    has_odds_ |= match.inlier_odds != problem.matches.front().inlier_odds;
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
    case Solver::three_bearings:
      return with_depth_.size() > 2;
    case Solver::three_depth:
    case Solver::automatic:
      break;
  }
  return false;
}

double MinimalSampler::sampleCount(Solver kind) const {
  constexpr double many = 0x1p53;  // integers up to here are exact
  const auto n = static_cast<double>(rays_.size()), d = static_cast<double>(with_depth_.size());
  if (kind == Solver::two_depth) return std::min(d * (d - 1) / 2, many);
  if (kind == Solver::three_bearings) return std::min(d * (d - 1) * (d - 2) / 6, many);
  return std::min(kind == Solver::three_rays ? n * (n - 1) * (n - 2) / 6 : d * (n - 1), many);
}

double MinimalSampler::chanceOfInliers(Solver kind, const std::vector<int>& inliers) const {
  const bool by_odds = drawsByOdds(kind);
  std::vector<char> is_inlier(rays_.size());  // by match: each has a ray
  for (const int match : inliers) is_inlier[std::size_t(match)] = true;
  const auto isInlier = [&](std::size_t ray) { return is_inlier[std::size_t(match_of_ray_[ray])]; };
  double any = 0, deep = 0;
  for (std::size_t i = 0; i < rays_.size(); ++i)
    if (isInlier(i)) any += (by_odds ? ray_chances_.share(i) : 1.0 / static_cast<double>(rays_.size()));
  for (std::size_t i = 0; i < with_depth_.size(); ++i)
    if (isInlier(ray_of_depth_[i]))
      deep += (by_odds ? depth_chances_.share(i) : 1.0 / static_cast<double>(with_depth_.size()));
  if (kind == Solver::two_depth) return deep * deep;
  if (kind == Solver::three_bearings) return deep * deep * deep;
  return kind == Solver::three_rays ? any * any * any : deep * any;
}

bool MinimalSampler::drawsByOdds(Solver kind) const {
  constexpr double few = 256;  // are all tried, whatever their odds
  return has_odds_ && sampleCount(kind) > few;
}

void MinimalSampler::draw(Solver kind, int count, std::vector<PlanarTransform>& poses) {
  EvenOrder& order = orders_.try_emplace(kind, static_cast<uint64_t>(sampleCount(kind)), random_).first->second;
  const bool by_odds = drawsByOdds(kind);
  for (int i = 0; i < count; ++i) addPoses(kind, by_odds ? likelyMembers(kind) : membersOf(kind, order.next()), poses);
}

MinimalSampler::Members MinimalSampler::likelyMembers(Solver kind) {
  const auto depth = [&] { return depth_chances_.draw(random_); };
  const auto ray = [&] { return ray_chances_.draw(random_); };
  while (true) {
    if (kind == Solver::one_point_one_depth) {
      const Members members{depth(), ray()};
      if (ray_of_depth_[members[0]] != members[1]) return members;
    } else if (kind == Solver::two_depth) {
      const Members members{depth(), depth()};
      if (members[0] != members[1]) return members;
    } else {
      const bool of_depth = kind == Solver::three_bearings;
      const Members members = of_depth ? Members{depth(), depth(), depth()} : Members{ray(), ray(), ray()};
      const auto& [a, b, c] = members;
      if (a != b && b != c && c != a) return members;
    }
  }
}

MinimalSampler::Members MinimalSampler::membersOf(Solver kind, uint64_t sample) const {
  if (kind == Solver::one_point_one_depth) {
    const std::size_t depth = sample / (rays_.size() - 1), other = sample % (rays_.size() - 1);
    return {depth, other < ray_of_depth_[depth] ? other : other + 1};
  }
  if (kind == Solver::two_depth) {
    const uint64_t second = largestOf(sample, pairsOf);
    return {sample - pairsOf(second), second};
  }
  const uint64_t third = largestOf(sample, triplesOf);
  sample -= triplesOf(third);
  const uint64_t second = largestOf(sample, pairsOf);
  return {sample - pairsOf(second), second, third};
}

void MinimalSampler::addPoses(Solver kind, const Members& members, std::vector<PlanarTransform>& poses) const {
  const auto& [a, b, c] = members;
  const auto add = [&](const PlanarRoots& found) {
    poses.insert(poses.end(), found.roots.begin(), found.roots.begin() + found.count);
  };
  if (kind == Solver::one_point_one_depth) {
    add(solveOnePointOneDepth(with_depth_[a], rays_[b]));
  } else if (kind == Solver::three_bearings) {
    add(solveThreeBearings({with_depth_[a], with_depth_[b], with_depth_[c]}));
  } else if (kind == Solver::two_depth) {
    if (const auto pose = solveDepthPoints(std::array{with_depth_[a], with_depth_[b]})) poses.push_back(*pose);
  } else {
    const std::vector<PlanarTransform> found = solveThreeRays({rays_[a], rays_[b], rays_[c]});
    poses.insert(poses.end(), found.begin(), found.end());
  }
}

}  // namespace vmcl

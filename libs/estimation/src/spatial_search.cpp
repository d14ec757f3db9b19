// SPDX-License-Identifier: BSD-3-Clause
#include "spatial_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "best_distinct.h"
#include "three_points.h"
#include "upright_points.h"
#include "vmcl/estimation/match_rays.h"
#include "vmcl/estimation/sample_worth.h"
#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

/// Matches with depth of the cameras that see enough for a sample.
class SpatialSampler {
 public:
  SpatialSampler(const PoseProblem& problem, const EstimatorOptions& options)
      : size_(options.motion == Motion::free ? 3 : 2), random_(options.seed) {
    std::map<int, std::vector<int>> by_camera;
    for (int i = 0; i < static_cast<int>(problem.matches.size()); ++i) {
      const Match& match = problem.matches[static_cast<std::size_t>(i)];
      if (match.point) by_camera[size_ == 3 ? match.query_camera : 0].push_back(i);
    }
    for (const auto& [camera, matches] : by_camera) {
      if (matches.size() < size_) continue;
      groups_.push_back({});
      for (const int i : matches) {
        const Match& match = problem.matches[static_cast<std::size_t>(i)];
        groups_.back().push_back({i, {raysOfMatch(problem, match).ray_in_robot, match.point->point_in_map}});
      }
    }
  }

  bool canDraw() const { return !groups_.empty(); }
  Solver kind() const { return size_ == 3 ? Solver::three_depth : Solver::two_depth; }

  std::vector<Rigid3> draw() {
    const std::vector<DepthMatch>& group = groups_[random_.below(static_cast<uint32_t>(groups_.size()))];
    std::array<std::size_t, 3> drawn{};
    for (std::size_t k = 0; k < size_; ++k) {
      const auto taken = drawn.begin() + static_cast<std::ptrdiff_t>(k);
      do drawn[k] = random_.below(static_cast<uint32_t>(group.size()));
      while (std::find(drawn.begin(), taken, drawn[k]) != taken);
    }
    const auto member = [&](std::size_t k) { return group[drawn[k]].rays; };
    return size_ == 3 ? solveThreePoints({member(0), member(1), member(2)}) : solveUprightPoints(member(0), member(1));
  }

  /// That a sample holds no outlier, if these are the inliers (increasing indices).
  double chanceOfInliers(const std::vector<int>& inliers) const {
    double sum = 0;
    for (const std::vector<DepthMatch>& group : groups_) {
      const auto right = std::ranges::count_if(group, [&](const DepthMatch& match) {
        return std::binary_search(inliers.begin(), inliers.end(), match.index);
      });
      sum += std::pow(static_cast<double>(right) / static_cast<double>(group.size()), size_);
    }
    return sum / static_cast<double>(groups_.size());
  }

 private:
  struct DepthMatch {
    int index;
    RayToPoint rays;
  };

  std::size_t size_;  ///< of a sample
  std::vector<std::vector<DepthMatch>> groups_;
  Random random_;
};

/// Hypotheses that optimization takes to the same place.
bool alike(const Rigid3& a, const Rigid3& b) {
  constexpr double near = 0.02;  // m, rad
  return (a.translation() - b.translation()).norm() < near && (a.linear() - b.linear()).norm() < near;
}

}  // namespace

std::optional<std::vector<SpatialHypothesis>> searchSpatialSamples(const PoseProblem& problem,
                                                                   const PoseLikelihood& likelihood,
                                                                   const EstimatorOptions& options) {
  constexpr int at_first = 64;
  SpatialSampler sampler(problem, options);
  if (!sampler.canDraw()) return std::nullopt;
  const PoseRefiner refiner(likelihood, {});
  std::vector<Rigid3> poses;
  std::vector<double> scores;
  double best = -std::numeric_limits<double>::infinity();
  int wanted = std::min(at_first, options.iterations);
  for (int drawn = 0; drawn < wanted; ++drawn)
    for (const Rigid3& pose : sampler.draw()) {
      poses.push_back(pose);
      scores.push_back(likelihood(pose));
      if (scores.back() <= best) continue;
      best = scores.back();
      const double needed = samplesNeeded(sampler.chanceOfInliers(refiner.inliers(RefinedPose::at(pose))));
      wanted = static_cast<int>(std::min(std::max(needed, double{at_first}), double(options.iterations)));
    }
  std::vector<SpatialHypothesis> result;
  const auto are_alike = [&](std::size_t a, std::size_t b) { return alike(poses[a], poses[b]); };
  for (const std::size_t i : bestDistinct(scores, static_cast<std::size_t>(options.refined), are_alike))
    result.push_back({poses[i], sampler.kind()});
  return result;
}

}  // namespace vmcl

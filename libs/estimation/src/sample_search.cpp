// SPDX-License-Identifier: BSD-3-Clause
#include "sample_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "best_distinct.h"
#include "minimal_sampler.h"
#include "vmcl/estimation/sample_worth.h"

namespace vmcl {
namespace {

/// Hypotheses that optimization takes to the same place, so that one of them is enough (m, rad).
bool alike(const Hypothesis& a, const Hypothesis& b) {
  constexpr double near = 0.02;
  const double dx = a.pose.x - b.pose.x, dy = a.pose.y - b.pose.y;
  return dx * dx + dy * dy < near * near && std::abs(a.pose.s * b.pose.c - a.pose.c * b.pose.s) < near &&
         a.pose.c * b.pose.c + a.pose.s * b.pose.s > 0;
}

/// Kinds of samples that are wanted and possible.
std::vector<Solver> kindsToDraw(const MinimalSampler& sampler, Solver wanted) {
  std::vector<Solver> kinds;
  for (const Solver kind : {Solver::two_depth, Solver::one_point_one_depth})
    if ((wanted == kind || wanted == Solver::automatic) && sampler.canDraw(kind)) kinds.push_back(kind);
  const bool rays_alone = wanted == Solver::automatic && kinds.empty();
  const Solver other = rays_alone ? Solver::three_rays : wanted;
  const bool is_other = other == Solver::three_rays || other == Solver::three_bearings;
  if (is_other && sampler.canDraw(other)) kinds.push_back(other);
  return kinds;
}

/// RANSAC that draws as many samples of each kind, until one without outliers is all but certain, by the best pose so
/// far.
class Search {
 public:
  Search(const PoseProblem& problem, const PoseLikelihood& likelihood, const EstimatorOptions& options)
      : sampler_(problem, options.likelihood.inlier_prior, options.seed),
        likelihood_(likelihood),
        refiner_(likelihood, {}) {
    for (const Solver solver : kindsToDraw(sampler_, options.solver)) kinds_.push_back({solver});
    if (kinds_.empty()) return;
    constexpr int at_first = 64;  // samples of each kind before any rule
    int left = options.iterations, drawn = 1;
    for (int each = std::clamp(left / static_cast<int>(kinds_.size()), 1, at_first); each > 0 && drawn > 0;
         each = moreOfEach()) {
      drawn = 0;
      for (Kind& kind : kinds_) drawn += draw(kind, std::min(each, left - drawn));
      left -= drawn;
      of_each_ += each;
    }
  }

  bool canDraw() const { return !kinds_.empty(); }

  /// The best hypotheses, alike ones once, the best first.
  std::vector<Hypothesis> best(int count) const {
    const auto are_alike = [&](std::size_t a, std::size_t b) { return alike(hypotheses_[a], hypotheses_[b]); };
    std::vector<Hypothesis> result;
    for (const std::size_t i : bestDistinct(scores_, static_cast<std::size_t>(count), are_alike))
      result.push_back(hypotheses_[i]);
    return result;
  }

 private:
  struct Kind {
    Solver solver;
    int drawn = 0;
  };

  int samplesLeft(const Kind& kind) const {
    constexpr double many = std::numeric_limits<int>::max();
    return static_cast<int>(std::min(sampler_.sampleCount(kind.solver) - kind.drawn, many));
  }

  /// As many more as RANSAC's rule asks, but no more than double what was drawn. Kinds that are used up do not count.
  int moreOfEach() const {
    double chance_of_none = 1;
    for (const Kind& kind : kinds_)
      if (samplesLeft(kind) > 0) chance_of_none *= 1 - sampler_.chanceOfInliers(kind.solver, inliers_);
    return static_cast<int>(std::min(samplesNeeded(1 - chance_of_none) - of_each_, 1.0 * of_each_));
  }

  /// So many samples, or all that are left; returns how many.
  int draw(Kind& kind, int count) {
    count = std::min(count, samplesLeft(kind));
    std::vector<PlanarTransform> poses;
    sampler_.draw(kind.solver, count, poses);
    std::erase_if(poses, [](const PlanarTransform& pose) {
      return !std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.c) || !std::isfinite(pose.s);
    });
    std::vector<double> scores(poses.size());
    likelihood_.evaluate(poses, scores);
    const auto top = std::max_element(scores.begin(), scores.end());
    if (top != scores.end() && *top > best_score_) {
      best_score_ = *top;
      RefinedPose pose;
      pose.map_from_robot = poses[static_cast<std::size_t>(top - scores.begin())].pose();
      inliers_ = refiner_.inliers(pose);
    }
    for (const PlanarTransform& pose : poses) hypotheses_.push_back({pose, kind.solver});
    scores_.insert(scores_.end(), scores.begin(), scores.end());
    kind.drawn += count;
    return count;
  }

  MinimalSampler sampler_;
  const PoseLikelihood& likelihood_;
  PoseRefiner refiner_;
  std::vector<Kind> kinds_;
  int of_each_ = 0;  ///< samples drawn of each kind, where there are so many
  std::vector<Hypothesis> hypotheses_;
  std::vector<double> scores_;
  double best_score_ = -std::numeric_limits<double>::infinity();
  std::vector<int> inliers_;  ///< of the best pose so far
};

}  // namespace

std::optional<std::vector<Hypothesis>> searchSamples(const PoseProblem& problem, const PoseLikelihood& likelihood,
                                                     const EstimatorOptions& options) {
  const Search search(problem, likelihood, options);
  if (!search.canDraw()) return std::nullopt;
  return search.best(options.refined);
}

}  // namespace vmcl

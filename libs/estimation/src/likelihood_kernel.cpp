// SPDX-License-Identifier: BSD-3-Clause
// The likelihood of many planar poses at once, a pose a lane. Matches that add nothing at any pose of a vector are
// sifted out in single precision. The residuals of the others are small differences of large numbers and taken in
// double precision, what follows from them in single.

#include "vmcl/geometry/instruction_sets.h"

// Compiled once for each instruction set, that of every machine of its kind included; the best for the machine is
// chosen when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "likelihood_kernel.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include <algorithm>
#include <cmath>
#include <numbers>

#include "point_odds-inl.h"
#include "ray_odds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t lanes = hn::MaxLanes(FloatTag());

/// Poses relative to the origin of the terms; those out of reach stand at the origin.
struct PoseBlock {
  HWY_ALIGN double c[lanes], s[lanes], x[lanes], y[lanes];

  PoseBlock(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const PlanarTransform& pose = map_from_robot[std::min(i, map_from_robot.size() - 1)];
      const bool near = isWithinReach(terms, pose);
      c[i] = near ? pose.c : 1;
      s[i] = near ? pose.s : 0;
      x[i] = near ? pose.x - terms.origin.x() : 0;
      y[i] = near ? pose.y - terms.origin.y() : 0;
    }
  }
};

HWY_INLINE Poses lanesOf(const PoseBlock& block) {
  const PoseLanes<Double> fine{load(block.c), load(block.s), load(block.x), load(block.y)};
  return {fine, {rounded(fine.c), rounded(fine.s), rounded(fine.x), rounded(fine.y)}};
}

/// Calls on_match(odds, term) for the matches of a group that may add anything. First lists them, so that the processor
/// need not guess.
template <class Odds, class Group, class OnMatch>
HWY_INLINE void visit(const Group& group, const Poses& poses, OnMatch&& on_match) {
  constexpr std::size_t chunk = 256;
  const Odds odds(group, poses);
  uint16_t listed[chunk];
  for (std::size_t first = 0; first < group.terms.size(); first += chunk) {
    const std::size_t size = std::min(chunk, group.terms.size() - first);
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
      listed[count] = static_cast<uint16_t>(i);
      count += !hn::AllFalse(FloatTag(), odds.passes(group.gates[first + i]));
    }
    for (std::size_t i = 0; i < count; ++i) on_match(odds, group.terms[first + listed[i]]);
  }
}

template <class OnMatch>
HWY_INLINE void visit(const LikelihoodTerms& terms, const Poses& poses, OnMatch&& on_match) {
  for (const PointTerms& group : terms.points) visit<PointOdds>(group, poses, on_match);
  for (const RayTerms& group : terms.rays) visit<RayOdds>(group, poses, on_match);
}

/// L of each pose: on_value(lane, L).
template <class OnValue>
HWY_INLINE void readLogLikelihoods(const LikelihoodTerms& terms, LongProduct& product, std::size_t count,
                                   OnValue&& on_value) {
  product.renormalize();
  HWY_ALIGN float log_mantissa[lanes];
  HWY_ALIGN int32_t exponent[lanes];
  hn::Store(hn::Log(FloatTag(), product.mantissa()), FloatTag(), log_mantissa);
  hn::Store(product.exponent(), IntTag(), exponent);
  for (std::size_t i = 0; i < count; ++i)
    on_value(i, terms.outlier_sum + exponent[i] * std::numbers::ln2 + double{log_mantissa[i]});
}

void evaluateBlock(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                   std::span<double> log_likelihoods) {
  const Poses poses = lanesOf(PoseBlock(terms, map_from_robot));
  LongProduct product(terms.matches_per_renormal);
  visit(terms, poses, [&](const auto& odds, const auto& term) HWY_ATTR { product.multiplyByOnePlus(odds.odds(term)); });
  readLogLikelihoods(terms, product, log_likelihoods.size(), [&](std::size_t i, double L) { log_likelihoods[i] = L; });
}

/// Each match pulls by its chance of being an inlier.
void linearizeBlock(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                    std::span<PlanarSlope> slopes) {
  const Poses poses = lanesOf(PoseBlock(terms, map_from_robot));
  LongProduct product(terms.matches_per_renormal);
  Float sums[9];
  for (Float& sum : sums) sum = all(0.0f);
  visit(terms, poses, [&](const auto& odds, const auto& term) HWY_ATTR {
    const MatchPull pull = odds.pull(term);
    product.multiplyByOnePlus(pull.odds);
    const Float weight = pull.odds / (all(1.0f) + pull.odds);
    const Mask pulls = pull.odds > all(0.0f);
    for (int i = 0; i < 3; ++i) sums[i] = sums[i] + hn::IfThenElseZero(pulls, weight * pull.gradient[i]);
    for (int i = 0; i < 6; ++i) sums[3 + i] = sums[3 + i] + hn::IfThenElseZero(pulls, weight * pull.information[i]);
  });
  readLogLikelihoods(terms, product, slopes.size(), [&](std::size_t i, double L) { slopes[i].log_likelihood = L; });
  HWY_ALIGN float stored[9][lanes];
  for (int k = 0; k < 9; ++k) hn::Store(sums[k], FloatTag(), stored[k]);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const auto at = [&](int k) { return double{stored[k][i]}; };
    Eigen::Matrix3d map_from_robot_axes = Eigen::Matrix3d::Identity();
    const auto& [c, s, x, y] = map_from_robot[i];
    map_from_robot_axes.topLeftCorner<2, 2>() << c, -s, s, c;
    Eigen::Matrix3d information;
    information << at(3), at(4), at(5), at(4), at(6), at(7), at(5), at(7), at(8);
    slopes[i].gradient = map_from_robot_axes * Eigen::Vector3d(at(0), at(1), at(2));
    slopes[i].information = map_from_robot_axes * information * map_from_robot_axes.transpose();
  }
}

template <class Value, class Block>
void inBlocks(std::span<const PlanarTransform> map_from_robot, std::span<Value> values, Block&& block) {
  for (std::size_t first = 0; first < map_from_robot.size(); first += lanes) {
    const std::size_t count = std::min(lanes, map_from_robot.size() - first);
    block(map_from_robot.subspan(first, count), values.subspan(first, count));
  }
}

void evaluateBlocks(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                    std::span<double> log_likelihoods) {
  inBlocks(map_from_robot, log_likelihoods, [&](auto poses, auto values) { evaluateBlock(terms, poses, values); });
}

void linearizeBlocks(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                     std::span<PlanarSlope> slopes) {
  inBlocks(map_from_robot, slopes, [&](auto poses, auto values) { linearizeBlock(terms, poses, values); });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vmcl {

HWY_EXPORT(evaluateBlocks);
HWY_EXPORT(linearizeBlocks);

void evaluateTerms(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                   std::span<double> log_likelihoods) {
  HWY_DYNAMIC_DISPATCH(evaluateBlocks)(terms, map_from_robot, log_likelihoods);
}

void linearizeTerms(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                    std::span<PlanarSlope> slopes) {
  HWY_DYNAMIC_DISPATCH(linearizeBlocks)(terms, map_from_robot, slopes);
}

}  // namespace vmcl
#endif

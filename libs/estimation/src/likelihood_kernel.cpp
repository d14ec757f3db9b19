// SPDX-License-Identifier: BSD-3-Clause
// The likelihood of many planar poses at once, a pose a lane. Matches that add nothing at any pose of a vector are
// sifted out in single precision. The residuals of the others are small differences of large numbers and taken in
// double precision, what follows from them in single.

#include "instruction_sets.h"

// Compiled once for each instruction set, the portable one included; the best for the machine is chosen when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "likelihood_kernel.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include <algorithm>
#include <cmath>
#include <numbers>

#include "match_odds-inl.h"

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

/// Multiplies by 1 + odds of all matches of a group. First lists those that may matter, so that the processor need not
/// guess.
template <class Odds, class Group>
HWY_INLINE void multiply(const Group& group, const Poses& poses, LongProduct& product) {
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
    for (std::size_t i = 0; i < count; ++i) product.multiplyByOnePlus(odds.odds(group.terms[first + listed[i]]));
  }
}

void evaluateBlock(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                   std::span<double> log_likelihoods) {
  const Poses poses = lanesOf(PoseBlock(terms, map_from_robot));
  LongProduct product(terms.matches_per_renormal);
  for (const PointTerms& group : terms.points) multiply<PointOdds>(group, poses, product);
  for (const RayTerms& group : terms.rays) multiply<RayOdds>(group, poses, product);
  product.renormalize();
  HWY_ALIGN float log_mantissa[lanes];
  HWY_ALIGN int32_t exponent[lanes];
  hn::Store(hn::Log(FloatTag(), product.mantissa()), FloatTag(), log_mantissa);
  hn::Store(product.exponent(), IntTag(), exponent);
  for (std::size_t i = 0; i < log_likelihoods.size(); ++i)
    log_likelihoods[i] = terms.outlier_sum + exponent[i] * std::numbers::ln2 + double{log_mantissa[i]};
}

void evaluateBlocks(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                    std::span<double> log_likelihoods) {
  for (std::size_t first = 0; first < map_from_robot.size(); first += lanes) {
    const std::size_t count = std::min(lanes, map_from_robot.size() - first);
    evaluateBlock(terms, map_from_robot.subspan(first, count), log_likelihoods.subspan(first, count));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vmcl {

HWY_EXPORT(evaluateBlocks);

void evaluateTerms(const LikelihoodTerms& terms, std::span<const PlanarTransform> map_from_robot,
                   std::span<double> log_likelihoods) {
  HWY_DYNAMIC_DISPATCH(evaluateBlocks)(terms, map_from_robot, log_likelihoods);
}

}  // namespace vmcl
#endif

// SPDX-License-Identifier: BSD-3-Clause
// The odds of each match being an inlier, as match_likelihood.h defines them; compiled again for each instruction set.
#if defined(VMCL_MATCH_ODDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VMCL_MATCH_ODDS_INL_H
#undef VMCL_MATCH_ODDS_INL_H
#else
#define VMCL_MATCH_ODDS_INL_H
#endif

#include "match_likelihood.h"
#include "simd_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {

/// Poses in both precisions.
struct Poses {
  PoseLanes<Double> fine;
  PoseLanes<Float> coarse;
};

/// For points in front of the camera.
HWY_INLINE Float nearFade(Float excess_depth) {
  const Float visible = hn::Min(excess_depth * all(static_cast<float>(1 / min_depth)), all(1.0f));
  return visible * visible;
}

/// Of matches with depth seen by one camera.
class PointOdds {
 public:
  using Term = PointTerm;

  HWY_INLINE PointOdds(const PointTerms& group, const Poses& poses) : group_(group), poses_(poses) {
    const auto turned = [&](const Eigen::Vector3f& axis, Float& x, Float& y) HWY_ATTR {
      x = negMulAdd(poses.coarse.s, all(axis.y()), poses.coarse.c * all(axis.x()));
      y = mulAdd(poses.coarse.s, all(axis.x()), poses.coarse.c * all(axis.y()));
    };
    turned(group.image_x, image_x_x_, image_x_y_);
    turned(group.image_y, image_y_x_, image_y_y_);
    turned(group.forward, forward_x_, forward_y_);
  }

  HWY_INLINE Mask passes(const MatchGate<PointRows<float>>& gate) const {
    Float u, v, depth;
    residual(poses_.coarse, gate.rows, u, v, depth);
    const Float depth2 = depth * depth;
    const Float bound = all(group_.gate_cutoff) * depth2 * (depth2 + all(gate.spread));
    return hn::And(depth > all(0.99f * static_cast<float>(min_depth)),
                   squaredNorm(u, v) * (depth2 - all(gate.pole)) < bound);
  }

  HWY_INLINE Float odds(const PointTerm& term) const {
    Double exact_u, exact_v, exact_depth;
    residual(poses_.fine, term.rows, exact_u, exact_v, exact_depth);
    const Float u = rounded(exact_u), v = rounded(exact_v), depth = rounded(exact_depth);
    const Float inverse_depth = all(1.0f) / depth;
    const Float pixel_u = mulAdd(u, inverse_depth, all(term.pixel_u));
    const Float pixel_v = mulAdd(v, inverse_depth, all(term.pixel_v));
    // a, b: depth times the derivatives of the predicted pixel by the point, times the root of the point's covariance.
    Float a_0, a_1, a_2, b_0, b_1, b_2;
    carry(term, negMulAdd(pixel_u, forward_x_, image_x_x_), negMulAdd(pixel_u, forward_y_, image_x_y_),
          negMulAdd(pixel_u, all(group_.forward.z()), all(group_.image_x.z())), a_0, a_1, a_2);
    carry(term, negMulAdd(pixel_v, forward_x_, image_y_x_), negMulAdd(pixel_v, forward_y_, image_y_y_),
          negMulAdd(pixel_v, all(group_.forward.z()), all(group_.image_y.z())), b_0, b_1, b_2);
    // S = depth^2 I + (a b)^T (a b): its determinant and u^T adj(S) u without cancellation.
    const Float depth2 = depth * depth;
    const Float trace = squaredNorm(a_0, a_1, a_2) + squaredNorm(b_0, b_1, b_2);
    const Float cross2 =
        squaredNorm(negMulAdd(a_2, b_1, a_1 * b_2), negMulAdd(a_0, b_2, a_2 * b_0), negMulAdd(a_1, b_0, a_0 * b_1));
    const Float determinant = mulAdd(depth2, depth2 + trace, cross2);
    const Float along2 =
        squaredNorm(negMulAdd(v, a_0, u * b_0), negMulAdd(v, a_1, u * b_1), negMulAdd(v, a_2, u * b_2));
    const Float distance2 = mulAdd(depth2, squaredNorm(u, v), along2) / determinant;
    const Float ratio = all(term.peak_odds) * depth2 / hn::Sqrt(determinant) * gaussian(distance2) *
                        nearFade(depth - all(static_cast<float>(min_depth)));
    return hn::IfThenElseZero(hn::And(depth > all(static_cast<float>(min_depth)), distance2 < all(group_.cutoff)),
                              ratio);
  }

 private:
  template <class Lanes, class T>
  static HWY_INLINE void residual(const PoseLanes<Lanes>& poses, const PointRows<T>& rows, Lanes& u, Lanes& v,
                                  Lanes& depth) {
    Lanes x, y;
    poses.toRobot(all(rows.x) - poses.x, all(rows.y) - poses.y, x, y);
    u = apply(rows.u, x, y);
    v = apply(rows.v, x, y);
    depth = apply(rows.depth, x, y);
  }

  static HWY_INLINE void carry(const PointTerm& term, Float x, Float y, Float z, Float& r_0, Float& r_1, Float& r_2) {
    const auto& root = term.covariance_root;
    r_0 = mulAdd(all(root[0]), x, mulAdd(all(root[1]), y, all(root[2]) * z));
    r_1 = mulAdd(all(root[3]), y, all(root[4]) * z);
    r_2 = all(root[5]) * z;
  }

  const PointTerms& group_;
  const Poses& poses_;
  Float image_x_x_, image_x_y_, image_y_x_, image_y_y_, forward_x_, forward_y_;
};

/// Of matches without depth between one query and one reference camera.
class RayOdds {
 public:
  HWY_INLINE RayOdds(const RayTerms& group, const Poses& poses) : group_(group), poses_(poses) {
    poses.fine.toRobot(all(group.reference.x()) - poses.fine.x, all(group.reference.y()) - poses.fine.y, reference_x_,
                       reference_y_);
    coarse_x_ = rounded(reference_x_);
    coarse_y_ = rounded(reference_y_);
    parallax_depth_ = rounded(apply(group.parallax_depth, reference_x_, reference_y_));
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 2; ++k)
        homography_[i][k] = apply(group.homography[std::size_t(i)][std::size_t(k)], poses.coarse.c, poses.coarse.s);
  }

  HWY_INLINE Mask passes(const MatchGate<RayRows<float>>& gate) const {
    const auto& rows = gate.rows;
    const auto& [c, s, x, y] = poses_.coarse;
    const Float infinite_u = apply(rows.infinite_u, c, s), infinite_v = apply(rows.infinite_v, c, s);
    const Float parallax_u = apply(rows.parallax_u, coarse_x_, coarse_y_);
    const Float parallax_v = apply(rows.parallax_v, coarse_x_, coarse_y_);
    const Float rho = nearestInverseDepth(infinite_u, infinite_v, parallax_u, parallax_v,
                                          inverseParallax2(parallax_u, parallax_v), all(0.0f));
    const Float depth = mulAdd(rho, parallax_depth_, apply(rows.infinite_depth, c, s)), depth2 = depth * depth;
    const Float error2 = squaredNorm(mulAdd(rho, parallax_u, infinite_u), mulAdd(rho, parallax_v, infinite_v));
    const Float bound = all(group_.gate_cutoff) * depth2 * (depth2 + all(gate.spread));
    return hn::And(depth > hn::Zero(FloatTag()), error2 * (depth2 - all(gate.pole)) < bound);
  }

  HWY_INLINE Float odds(const RayTerm& term) const {
    const auto& rows = term.rows;
    const auto& [c, s, x, y] = poses_.fine;
    const Double exact_infinite_u = apply(rows.infinite_u, c, s), exact_infinite_v = apply(rows.infinite_v, c, s);
    const Double exact_parallax_u = apply(rows.parallax_u, reference_x_, reference_y_);
    const Double exact_parallax_v = apply(rows.parallax_v, reference_x_, reference_y_);
    const Float parallax_u = rounded(exact_parallax_u), parallax_v = rounded(exact_parallax_v);
    const Float per_parallax2 = inverseParallax2(parallax_u, parallax_v);
    const Float rho = nearestInverseDepth(rounded(exact_infinite_u), rounded(exact_infinite_v), parallax_u, parallax_v,
                                          per_parallax2, all(0.0f));
    const Double exact_rho = widened(rho);
    Float u = rounded(mulAdd(exact_rho, exact_parallax_u, exact_infinite_u));
    Float v = rounded(mulAdd(exact_rho, exact_parallax_v, exact_infinite_v));
    const Float correction = nearestInverseDepth(u, v, parallax_u, parallax_v, per_parallax2, rho);
    u = mulAdd(correction, parallax_u, u);
    v = mulAdd(correction, parallax_v, v);
    const Float depth = mulAdd(rho, parallax_depth_, rounded(apply(rows.infinite_depth, c, s)));
    const Float inverse_depth = all(1.0f) / depth, depth2 = depth * depth;
    const Float error_u = u * inverse_depth, error_v = v * inverse_depth;
    // S = depth^2 I + D D^T with D depth times the derivative of the predicted by the reference pixel.
    const Float pixel_u = mulAdd(all(group_.sigma_px), error_u, all(term.pixel_u_px));
    const Float pixel_v = mulAdd(all(group_.sigma_px), error_v, all(term.pixel_v_px));
    const Float D_00 = negMulAdd(pixel_u, homography_[2][0], homography_[0][0]);
    const Float D_01 = negMulAdd(pixel_u, homography_[2][1], homography_[0][1]);
    const Float D_10 = negMulAdd(pixel_v, homography_[2][0], homography_[1][0]);
    const Float D_11 = negMulAdd(pixel_v, homography_[2][1], homography_[1][1]);
    // Its determinant and inverse as sums of squares: differences would cancel where D is nearly singular.
    const Float D_determinant = negMulAdd(D_01, D_10, D_00 * D_11);
    const Float D_norm2 = squaredNorm(D_00, D_01) + squaredNorm(D_10, D_11);
    const Float inverse_determinant = all(1.0f) / mulAdd(depth2, depth2 + D_norm2, D_determinant * D_determinant);
    const auto distance2 = [&](Float e_u, Float e_v) HWY_ATTR {
      const Float through_D = squaredNorm(negMulAdd(D_10, e_u, D_00 * e_v), negMulAdd(D_11, e_u, D_01 * e_v));
      return mulAdd(depth2, squaredNorm(e_u, e_v), through_D) * inverse_determinant;
    };
    const Float error2 = distance2(u, v);
    const Float by_rho_u = negMulAdd(error_u, parallax_depth_, parallax_u);
    const Float by_rho_v = negMulAdd(error_v, parallax_depth_, parallax_v);
    const Float peak = all(term.peak_odds) * depth2 * hn::Sqrt(inverse_determinant);
    const Float along = alongSegment(rho, distance2(by_rho_u, by_rho_v) + all(static_cast<float>(tiny_information)),
                                     squaredNorm(by_rho_u, by_rho_v) * inverse_depth * inverse_depth);
    const Float near_depth = rho * all(static_cast<float>(min_depth));
    const Float ratio = peak * gaussian(error2) * along * nearFade(depth - near_depth);
    const Mask in_front = depth > hn::Max(near_depth, all(static_cast<float>(min_ray_depth)));
    return hn::IfThenElseZero(hn::And(in_front, error2 < all(group_.cutoff)), ratio);
  }

 private:
  HWY_INLINE Float inverseParallax2(Float parallax_u, Float parallax_v) const {
    return all(1.0f) / (squaredNorm(parallax_u, parallax_v) + all(group_.tiny_parallax2));
  }

  /// What to add to the inverse depth `from`, at which the residual is (u, v), for the nearest within bounds.
  static HWY_INLINE Float nearestInverseDepth(Float u, Float v, Float parallax_u, Float parallax_v, Float per_parallax2,
                                              Float from) {
    const Float step = hn::Neg(mulAdd(u, parallax_u, v * parallax_v)) * per_parallax2;
    return hn::Min(hn::Max(step, hn::Neg(from)), all(static_cast<float>(max_inverse_depth)) - from);
  }

  /// Density at rho, known with this information, over the peak of the measurement's density.
  HWY_INLINE Float alongSegment(Float rho, Float information, Float by_rho2) const {
    const Float narrowing = all(1.0f) / mulAdd(all(group_.prior_variance), information, all(1.0f));
    const Float off = rho - all(group_.prior_mean);
    const Float described = hn::Sqrt(narrowing) * gaussian(off * off * information * narrowing);
    const Float anywhere = hn::Min(hn::Sqrt(all(group_.segment_scale) * by_rho2 / information), all(1.0f));
    constexpr auto share = static_cast<float>(described_share);
    return mulAdd(all(share), described, all(1 - share) * anywhere);
  }

  const RayTerms& group_;
  const Poses& poses_;
  Double reference_x_, reference_y_;  // on the ground, robot frame
  Float coarse_x_, coarse_y_;
  Float parallax_depth_;
  Float homography_[3][2];
};

}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#endif

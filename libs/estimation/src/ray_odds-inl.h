// SPDX-License-Identifier: BSD-3-Clause
// Matches without depth, as match_likelihood.h defines them; compiled again for each instruction set.
#if defined(VMCL_RAY_ODDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VMCL_RAY_ODDS_INL_H
#undef VMCL_RAY_ODDS_INL_H
#else
#define VMCL_RAY_ODDS_INL_H
#endif

#include "match_pull-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {

/// S = depth^2 I + D D^T, the covariance of a residual times depth. Its determinant and inverse are sums of squares:
/// differences would cancel where D is nearly singular.
class ResidualCovariance {
 public:
  HWY_INLINE ResidualCovariance(Float depth2, Float D_00, Float D_01, Float D_10, Float D_11)
      : depth2_(depth2), D_00_(D_00), D_01_(D_01), D_10_(D_10), D_11_(D_11) {
    const Float determinant = negMulAdd(D_01, D_10, D_00 * D_11);
    D_u2_ = squaredNorm(D_00, D_01);
    D_v2_ = squaredNorm(D_10, D_11);
    inverse_determinant_ = all(1.0f) / mulAdd(depth2, depth2 + D_u2_ + D_v2_, determinant * determinant);
  }

  HWY_INLINE Float inverseDeterminant() const { return inverse_determinant_; }

  /// e^T S^-1 e.
  HWY_INLINE Float distance2(Float e_u, Float e_v) const {
    const Float through_D = squaredNorm(negMulAdd(D_10_, e_u, D_00_ * e_v), negMulAdd(D_11_, e_u, D_01_ * e_v));
    return mulAdd(depth2_, squaredNorm(e_u, e_v), through_D) * inverse_determinant_;
  }

  HWY_INLINE PixelMatrix inverse() const {
    const Float off_diagonal = hn::Neg(mulAdd(D_00_, D_10_, D_01_ * D_11_));
    return {(depth2_ + D_v2_) * inverse_determinant_, off_diagonal * inverse_determinant_,
            (depth2_ + D_u2_) * inverse_determinant_};
  }

 private:
  Float depth2_, D_00_, D_01_, D_10_, D_11_;
  Float D_u2_, D_v2_, inverse_determinant_;
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

  HWY_INLINE Float odds(const RayTerm& term) const { return at(term).odds; }

  HWY_INLINE MatchPull pull(const RayTerm& term) const {
    const Residual r = at(term);
    const auto& [c, s, x, y] = poses_.coarse;
    const auto slope = [&](const PlaneRow<double>& infinite, const PlaneRow<double>& parallax, Float error) HWY_ATTR {
      const auto turned = [&](const PlaneRow<double>& row)
                              HWY_ATTR { return negMulAdd(s, allRounded(row.x), c * allRounded(row.y)); };
      const Float by_x = r.rho * negMulAdd(error, allRounded(group_.parallax_depth.x), allRounded(parallax.x));
      const Float by_y = r.rho * negMulAdd(error, allRounded(group_.parallax_depth.y), allRounded(parallax.y));
      const Float by_turn = mulAdd(error, turned(term.rows.infinite_depth), hn::Neg(turned(infinite)));
      return PixelSlope{by_x, by_y, by_turn + negMulAdd(by_x, coarse_y_, by_y * coarse_x_)};
    };
    const PixelSlope across = slope(term.rows.infinite_u, term.rows.parallax_u, r.error_u);
    const PixelSlope down = slope(term.rows.infinite_v, term.rows.parallax_v, r.error_v);
    MatchPull pull = pullOf(r.odds, r.weight, r.u, r.v, across, down);
    // As far as the prior describes the point, its error lies at the prior's mean and spreads along the segment as the
    // prior says; else it is unknown along the segment.
    Float segment_u, segment_v;
    multiply(r.weight, r.by_rho_u, r.by_rho_v, segment_u, segment_v);
    const Float information = r.information;
    const Float prior_share = allRounded(prior_weight) * r.described;
    const Float described = prior_share / mulAdd(all(group_.prior_variance), information, all(1.0f));
    const Float unknown = mulAdd(allRounded(unknown_scale) * r.rho, r.rho, all(1.0f) / information);
    const Float narrowing = mulAdd(described, all(group_.prior_variance),
                                   (all(1.0f) - prior_share) * unknown / mulAdd(unknown, information, all(1.0f)));
    const Float along = mulAdd(r.u, segment_u, r.v * segment_v);
    const Float to_mean = negMulAdd(narrowing, along, described * (all(group_.prior_mean) - r.rho));
    const Float h[3] = {mulAdd(across.forward, segment_u, down.forward * segment_v),
                        mulAdd(across.left, segment_u, down.left * segment_v),
                        mulAdd(across.turn, segment_u, down.turn * segment_v)};
    for (int i = 0, next = 0; i < 3; ++i) {
      pull.gradient[i] = mulAdd(to_mean, h[i], pull.gradient[i]);
      for (int k = i; k < 3; ++k, ++next)
        pull.information[next] = negMulAdd(narrowing * h[i], h[k], pull.information[next]);
    }
    return pull;
  }

 private:
  struct Residual {
    Float u, v, error_u, error_v;  ///< times depth, and not
    Float rho;
    Float by_rho_u, by_rho_v;  ///< derivative of the error by rho, times depth
    Float information;         ///< of rho, as the match measures it
    Float described;           ///< chance that the prior describes the point
    PixelMatrix weight;
    Float odds;
  };

  HWY_INLINE Residual at(const RayTerm& term) const {
    Residual r;
    const auto& rows = term.rows;
    const auto& [c, s, x, y] = poses_.fine;
    const Double exact_infinite_u = apply(rows.infinite_u, c, s), exact_infinite_v = apply(rows.infinite_v, c, s);
    const Double exact_parallax_u = apply(rows.parallax_u, reference_x_, reference_y_);
    const Double exact_parallax_v = apply(rows.parallax_v, reference_x_, reference_y_);
    const Float parallax_u = rounded(exact_parallax_u), parallax_v = rounded(exact_parallax_v);
    const Float per_parallax2 = inverseParallax2(parallax_u, parallax_v);
    const Float rho = r.rho = nearestInverseDepth(rounded(exact_infinite_u), rounded(exact_infinite_v), parallax_u,
                                                  parallax_v, per_parallax2, all(0.0f));
    const Double exact_rho = widened(rho);
    Float u = rounded(mulAdd(exact_rho, exact_parallax_u, exact_infinite_u));
    Float v = rounded(mulAdd(exact_rho, exact_parallax_v, exact_infinite_v));
    const Float correction = nearestInverseDepth(u, v, parallax_u, parallax_v, per_parallax2, rho);
    u = mulAdd(correction, parallax_u, u);
    v = mulAdd(correction, parallax_v, v);
    const Float depth = mulAdd(rho, parallax_depth_, rounded(apply(rows.infinite_depth, c, s)));
    const Float inverse_depth = all(1.0f) / depth, depth2 = depth * depth;
    const Float error_u = r.error_u = u * inverse_depth, error_v = r.error_v = v * inverse_depth;
    r.u = u;
    r.v = v;
    const ResidualCovariance S = covariance(term, depth2, error_u, error_v);
    const Float error2 = S.distance2(u, v);
    const Float by_rho_u = r.by_rho_u = negMulAdd(error_u, parallax_depth_, parallax_u);
    const Float by_rho_v = r.by_rho_v = negMulAdd(error_v, parallax_depth_, parallax_v);
    r.information = S.distance2(by_rho_u, by_rho_v) + allRounded(tiny_information);
    const Float peak = all(term.peak_odds) * depth2 * hn::Sqrt(S.inverseDeterminant());
    const Float along =
        alongSegment(rho, r.information, squaredNorm(by_rho_u, by_rho_v) * inverse_depth * inverse_depth, r.described);
    const Float near_depth = rho * allRounded(min_depth);
    const Float ratio = peak * gaussian(error2) * along * nearFade(depth - near_depth);
    const Mask in_front = depth > hn::Max(near_depth, allRounded(min_ray_depth));
    r.odds = hn::IfThenElseZero(hn::And(in_front, error2 < all(group_.cutoff)), ratio);
    r.weight = S.inverse();
    return r;
  }

  /// D is depth times the derivative of the predicted by the reference pixel.
  HWY_INLINE ResidualCovariance covariance(const RayTerm& term, Float depth2, Float error_u, Float error_v) const {
    const Float pixel_u = mulAdd(all(group_.sigma_px), error_u, all(term.pixel_u_px));
    const Float pixel_v = mulAdd(all(group_.sigma_px), error_v, all(term.pixel_v_px));
    return {depth2, negMulAdd(pixel_u, homography_[2][0], homography_[0][0]),
            negMulAdd(pixel_u, homography_[2][1], homography_[0][1]),
            negMulAdd(pixel_v, homography_[2][0], homography_[1][0]),
            negMulAdd(pixel_v, homography_[2][1], homography_[1][1])};
  }

  HWY_INLINE Float inverseParallax2(Float parallax_u, Float parallax_v) const {
    return all(1.0f) / (squaredNorm(parallax_u, parallax_v) + all(group_.tiny_parallax2));
  }

  /// What to add to the inverse depth `from`, at which the residual is (u, v), for the nearest within bounds.
  static HWY_INLINE Float nearestInverseDepth(Float u, Float v, Float parallax_u, Float parallax_v, Float per_parallax2,
                                              Float from) {
    const Float step = hn::Neg(mulAdd(u, parallax_u, v * parallax_v)) * per_parallax2;
    return hn::Min(hn::Max(step, hn::Neg(from)), allRounded(max_inverse_depth) - from);
  }

  /// Density at rho, known with this information, over the peak of the measurement's density; and the chance that the
  /// point is one that the prior describes.
  HWY_INLINE Float alongSegment(Float rho, Float information, Float by_rho2, Float& chance_described) const {
    const Float narrowing = all(1.0f) / mulAdd(all(group_.prior_variance), information, all(1.0f));
    const Float off = rho - all(group_.prior_mean);
    const Float described = hn::Sqrt(narrowing) * gaussian(off * off * information * narrowing);
    const Float anywhere = hn::Min(hn::Sqrt(all(group_.segment_scale) * by_rho2 / information), all(1.0f));
    constexpr auto share = static_cast<float>(described_share);
    const Float sum = mulAdd(all(share), described, all(1 - share) * anywhere);
    chance_described = all(share) * described / sum;
    return sum;
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

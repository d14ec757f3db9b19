// SPDX-License-Identifier: BSD-3-Clause
// Matches with depth, as match_likelihood.h defines them; compiled again for each instruction set.
#if defined(VMCL_POINT_ODDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VMCL_POINT_ODDS_INL_H
#undef VMCL_POINT_ODDS_INL_H
#else
#define VMCL_POINT_ODDS_INL_H
#endif

#include "match_pull-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {

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
    Float x, y, u, v, depth;
    residual(poses_.coarse, gate.rows, x, y, u, v, depth);
    const Float depth2 = depth * depth;
    const Float bound = all(group_.gate_cutoff) * depth2 * (depth2 + all(gate.spread));
    return hn::And(depth > all(0.99f * static_cast<float>(min_depth)),
                   squaredNorm(u, v) * (depth2 - all(gate.pole)) < bound);
  }

  HWY_INLINE Float odds(const PointTerm& term) const { return at(term).odds; }

  HWY_INLINE MatchPull pull(const PointTerm& term) const {
    const Residual r = at(term);
    const Float x = rounded(r.x), y = rounded(r.y);
    const auto slope = [&](const PlaneRow<double>& row, Float error) HWY_ATTR {
      const Float by_x = negMulAdd(error, allRounded(term.rows.depth.x), allRounded(row.x));
      const Float by_y = negMulAdd(error, allRounded(term.rows.depth.y), allRounded(row.y));
      return PixelSlope{by_x, by_y, negMulAdd(by_x, y, by_y * x)};
    };
    return pullOf(r.odds, r.weight, r.u, r.v, slope(term.rows.u, r.u * r.inverse_depth),
                  slope(term.rows.v, r.v * r.inverse_depth));
  }

 private:
  struct Residual {
    Double x, y;  ///< of the point on the ground, robot frame
    Float u, v, inverse_depth;
    PixelMatrix weight;
    Float odds;
  };

  HWY_INLINE Residual at(const PointTerm& term) const {
    Residual r;
    Double exact_u, exact_v, exact_depth;
    residual(poses_.fine, term.rows, r.x, r.y, exact_u, exact_v, exact_depth);
    const Float u = r.u = rounded(exact_u), v = r.v = rounded(exact_v), depth = rounded(exact_depth);
    const Float inverse_depth = r.inverse_depth = all(1.0f) / depth;
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
    const Float a2 = squaredNorm(a_0, a_1, a_2), b2 = squaredNorm(b_0, b_1, b_2);
    const Float cross2 =
        squaredNorm(negMulAdd(a_2, b_1, a_1 * b_2), negMulAdd(a_0, b_2, a_2 * b_0), negMulAdd(a_1, b_0, a_0 * b_1));
    const Float inverse_determinant = all(1.0f) / mulAdd(depth2, depth2 + a2 + b2, cross2);
    const Float along2 =
        squaredNorm(negMulAdd(v, a_0, u * b_0), negMulAdd(v, a_1, u * b_1), negMulAdd(v, a_2, u * b_2));
    const Float distance2 = mulAdd(depth2, squaredNorm(u, v), along2) * inverse_determinant;
    const Float ratio = all(term.peak_odds) * depth2 * hn::Sqrt(inverse_determinant) * gaussian(distance2) *
                        nearFade(depth - allRounded(min_depth));
    r.odds = hn::IfThenElseZero(hn::And(depth > allRounded(min_depth), distance2 < all(group_.cutoff)), ratio);
    r.weight = {(depth2 + b2) * inverse_determinant,
                hn::Neg(mulAdd(a_0, b_0, mulAdd(a_1, b_1, a_2 * b_2))) * inverse_determinant,
                (depth2 + a2) * inverse_determinant};
    return r;
  }

  template <class Lanes, class T>
  static HWY_INLINE void residual(const PoseLanes<Lanes>& poses, const PointRows<T>& rows, Lanes& x, Lanes& y, Lanes& u,
                                  Lanes& v, Lanes& depth) {
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

}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#endif

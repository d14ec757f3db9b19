// SPDX-License-Identifier: BSD-3-Clause
// The odds of each match being an inlier, as match_likelihood.h defines them, and how its residual pulls at the pose;
// compiled again for each instruction set.
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

/// A match's odds, and the gradient and Gauss-Newton information of its residual over a motion of the robot in its own
/// frame: forward, left, turn.
struct MatchPull {
  Float odds;
  Float gradient[3];
  Float information[6];  ///< upper triangle by rows
};

/// One coordinate of the pixel error over that motion, times depth, the sign turned.
struct PixelSlope {
  Float forward, left, turn;
};

/// Symmetric, 2 x 2.
struct PixelMatrix {
  Float uu, uv, vv;
};

/// Both coordinates of a product with the matrix.
HWY_INLINE void multiply(const PixelMatrix& M, Float u, Float v, Float& out_u, Float& out_v) {
  out_u = mulAdd(M.uu, u, M.uv * v);
  out_v = mulAdd(M.uv, u, M.vv * v);
}

/// A residual (u, v) whose weight is W, both free of the depth that they were multiplied and divided by.
HWY_INLINE MatchPull pullOf(Float odds, const PixelMatrix& W, Float u, Float v, const PixelSlope& across,
                            const PixelSlope& down) {
  const Float g_u[3] = {across.forward, across.left, across.turn}, g_v[3] = {down.forward, down.left, down.turn};
  Float pull_u, pull_v;
  multiply(W, u, v, pull_u, pull_v);
  MatchPull pull{odds, {}, {}};
  for (int i = 0, next = 0; i < 3; ++i) {
    pull.gradient[i] = mulAdd(g_u[i], pull_u, g_v[i] * pull_v);
    Float row_u, row_v;
    multiply(W, g_u[i], g_v[i], row_u, row_v);
    for (int k = i; k < 3; ++k) pull.information[next++] = mulAdd(row_u, g_u[k], row_v * g_v[k]);
  }
  return pull;
}

/// For points in front of the camera.
HWY_INLINE Float nearFade(Float excess_depth) {
  const Float visible = hn::Min(excess_depth * single(1 / min_depth), all(1.0f));
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
      const Float by_x = negMulAdd(error, single(term.rows.depth.x), single(row.x));
      const Float by_y = negMulAdd(error, single(term.rows.depth.y), single(row.y));
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
                        nearFade(depth - single(min_depth));
    r.odds = hn::IfThenElseZero(hn::And(depth > single(min_depth), distance2 < all(group_.cutoff)), ratio);
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
                              HWY_ATTR { return negMulAdd(s, single(row.x), c * single(row.y)); };
      const Float by_x = r.rho * negMulAdd(error, single(group_.parallax_depth.x), single(parallax.x));
      const Float by_y = r.rho * negMulAdd(error, single(group_.parallax_depth.y), single(parallax.y));
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
    const Float described = r.described / mulAdd(all(group_.prior_variance), information, all(1.0f));
    const Float unknown = mulAdd(single(unknown_scale) * r.rho, r.rho, all(1.0f) / information);
    const Float narrowing = mulAdd(described, all(group_.prior_variance),
                                   (all(1.0f) - r.described) * unknown / mulAdd(unknown, information, all(1.0f)));
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
    const Float by_rho_u = r.by_rho_u = negMulAdd(error_u, parallax_depth_, parallax_u);
    const Float by_rho_v = r.by_rho_v = negMulAdd(error_v, parallax_depth_, parallax_v);
    r.information = distance2(by_rho_u, by_rho_v) + single(tiny_information);
    const Float peak = all(term.peak_odds) * depth2 * hn::Sqrt(inverse_determinant);
    const Float along =
        alongSegment(rho, r.information, squaredNorm(by_rho_u, by_rho_v) * inverse_depth * inverse_depth, r.described);
    const Float near_depth = rho * single(min_depth);
    const Float ratio = peak * gaussian(error2) * along * nearFade(depth - near_depth);
    const Mask in_front = depth > hn::Max(near_depth, single(min_ray_depth));
    r.odds = hn::IfThenElseZero(hn::And(in_front, error2 < all(group_.cutoff)), ratio);
    const Float D_u2 = squaredNorm(D_00, D_01), D_v2 = squaredNorm(D_10, D_11);
    r.weight = {(depth2 + D_v2) * inverse_determinant, hn::Neg(mulAdd(D_00, D_10, D_01 * D_11)) * inverse_determinant,
                (depth2 + D_u2) * inverse_determinant};
    return r;
  }

  HWY_INLINE Float inverseParallax2(Float parallax_u, Float parallax_v) const {
    return all(1.0f) / (squaredNorm(parallax_u, parallax_v) + all(group_.tiny_parallax2));
  }

  /// What to add to the inverse depth `from`, at which the residual is (u, v), for the nearest within bounds.
  static HWY_INLINE Float nearestInverseDepth(Float u, Float v, Float parallax_u, Float parallax_v, Float per_parallax2,
                                              Float from) {
    const Float step = hn::Neg(mulAdd(u, parallax_u, v * parallax_v)) * per_parallax2;
    return hn::Min(hn::Max(step, hn::Neg(from)), single(max_inverse_depth) - from);
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

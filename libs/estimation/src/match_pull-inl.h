// SPDX-License-Identifier: BSD-3-Clause
// What a match does at a pose: its odds of being an inlier, and how its residual pulls; compiled again for each
// instruction set.
#if defined(VMCL_MATCH_PULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VMCL_MATCH_PULL_INL_H
#undef VMCL_MATCH_PULL_INL_H
#else
#define VMCL_MATCH_PULL_INL_H
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

/// Of a residual (u, v), depth times the pixel error, whose weight is W: the depth cancels in all products.
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
  const Float visible = hn::Min(excess_depth * allRounded(1 / min_depth), all(1.0f));
  return visible * visible;
}

}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#endif

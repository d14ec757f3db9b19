// SPDX-License-Identifier: BSD-3-Clause
// Vector arithmetic, a planar pose a lane; compiled again for each instruction set.
#if defined(VMCL_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VMCL_SIMD_LANES_INL_H
#undef VMCL_SIMD_LANES_INL_H
#else
#define VMCL_SIMD_LANES_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "likelihood_terms.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Float = hn::Vec<FloatTag>;
using Int = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

/// As many lanes as a Float, in double precision.
#if HWY_TARGET == HWY_SCALAR
using Double = hn::Vec<hn::Rebind<double, FloatTag>>;
using DoubleTag = hn::DFromV<Double>;

HWY_INLINE Double mulAdd(Double a, Double b, Double c) { return hn::MulAdd(a, b, c); }
HWY_INLINE Double negMulAdd(Double a, Double b, Double c) { return hn::NegMulAdd(a, b, c); }
HWY_INLINE Double all(double value) { return hn::Set(DoubleTag(), value); }
HWY_INLINE Double load(const double* from) { return hn::Load(DoubleTag(), from); }
HWY_INLINE Float rounded(Double a) { return hn::DemoteTo(FloatTag(), a); }
HWY_INLINE Double widened(Float a) { return hn::PromoteTo(DoubleTag(), a); }
#else
using DoubleTag = hn::Repartition<double, FloatTag>;
struct Double {
  hn::Vec<DoubleTag> low, high;
};

HWY_INLINE Double operator-(const Double& a, const Double& b) { return {a.low - b.low, a.high - b.high}; }
HWY_INLINE Double operator*(const Double& a, const Double& b) { return {a.low * b.low, a.high * b.high}; }
HWY_INLINE Double mulAdd(const Double& a, const Double& b, const Double& c) {
  return {hn::MulAdd(a.low, b.low, c.low), hn::MulAdd(a.high, b.high, c.high)};
}
HWY_INLINE Double negMulAdd(const Double& a, const Double& b, const Double& c) {
  return {hn::NegMulAdd(a.low, b.low, c.low), hn::NegMulAdd(a.high, b.high, c.high)};
}
HWY_INLINE Double all(double value) {
  const auto lanes = hn::Set(DoubleTag(), value);
  return {lanes, lanes};
}
HWY_INLINE Double load(const double* from) {
  return {hn::Load(DoubleTag(), from), hn::Load(DoubleTag(), from + hn::MaxLanes(DoubleTag()))};
}
HWY_INLINE Float rounded(const Double& a) {
  const hn::Half<FloatTag> half;
  return hn::Combine(FloatTag(), hn::DemoteTo(half, a.high), hn::DemoteTo(half, a.low));
}
HWY_INLINE Double widened(Float a) {
  const hn::Half<FloatTag> half;
  return {hn::PromoteTo(DoubleTag(), hn::LowerHalf(half, a)), hn::PromoteTo(DoubleTag(), hn::UpperHalf(half, a))};
}
#endif

/// a b + c, c - a b, and the number in all lanes, as it is or rounded to single precision.
HWY_INLINE Float mulAdd(Float a, Float b, Float c) { return hn::MulAdd(a, b, c); }
HWY_INLINE Float negMulAdd(Float a, Float b, Float c) { return hn::NegMulAdd(a, b, c); }
HWY_INLINE Float all(float value) { return hn::Set(FloatTag(), value); }
HWY_INLINE Float allRounded(double value) { return all(static_cast<float>(value)); }

/// row over the vector (x, y).
template <class T, class Lanes>
HWY_INLINE Lanes apply(const PlaneRow<T>& row, const Lanes& x, const Lanes& y) {
  return mulAdd(all(row.x), x, mulAdd(all(row.y), y, all(row.constant)));
}

HWY_INLINE Float squaredNorm(Float x, Float y) { return mulAdd(x, x, y * y); }
HWY_INLINE Float squaredNorm(Float x, Float y, Float z) { return mulAdd(x, x, mulAdd(y, y, z * z)); }

/// exp(-distance2 / 2) to 2e-7, for distance2 >= 0; no less than e^-86.
HWY_INLINE Float gaussian(Float distance2) {
  constexpr float log2_e = 1.44269504f;
  const Float y = hn::Max(distance2 * all(-0.5f * log2_e), all(-125.0f));
  // Rounds to a whole number, which comes to stand in the last bits.
  const Float shift = all(12582912.0f), shifted = y + shift, f = y - (shifted - shift);
  const Int whole = hn::BitCast(IntTag(), shifted);
  // Minimax polynomial of 2^f on [-0.5, 0.5]; its relative error is 7.5e-8.
  Float power = mulAdd(all(1.327647198e-3f), f, all(9.675541334e-3f));
  power = mulAdd(power, f, all(5.550713274e-2f));
  power = mulAdd(power, f, all(2.402211972e-1f));
  power = mulAdd(power, f, all(6.931469671e-1f));
  power = mulAdd(power, f, all(1.000000072f));
  return hn::BitCast(FloatTag(), hn::BitCast(IntTag(), power) + hn::ShiftLeft<23>(whole));
}

/// Product of many factors of at least 1.
class LongProduct {
 public:
  HWY_INLINE explicit LongProduct(int factors_per_renormal)
      : mantissa_(all(1.0f)), exponent_(hn::Zero(IntTag())), left_(factors_per_renormal), period_(left_) {}

  HWY_INLINE void multiplyByOnePlus(Float odds) {
    mantissa_ = mulAdd(mantissa_, odds, mantissa_);
    if (--left_ == 0) renormalize();
  }

  HWY_INLINE void renormalize() {
    const Int bits = hn::BitCast(IntTag(), mantissa_), one = hn::BitCast(IntTag(), all(1.0f));
    exponent_ = exponent_ + (hn::ShiftRight<23>(bits) - hn::ShiftRight<23>(one));
    mantissa_ = hn::BitCast(FloatTag(), (bits & hn::Set(IntTag(), 0x007fffff)) | one);
    left_ = period_;
  }

  HWY_INLINE Float mantissa() const { return mantissa_; }  ///< in [1, 2) after renormalize()
  HWY_INLINE Int exponent() const { return exponent_; }

 private:
  Float mantissa_;
  Int exponent_;
  int left_, period_;
};

/// Planar poses: cosine and sine of the heading, position.
template <class Lanes>
struct PoseLanes {
  Lanes c, s, x, y;

  /// The ground part of a map vector in robot axes.
  HWY_INLINE void toRobot(const Lanes& map_x, const Lanes& map_y, Lanes& robot_x, Lanes& robot_y) const {
    robot_x = mulAdd(c, map_x, s * map_y);
    robot_y = negMulAdd(s, map_x, c * map_y);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#endif

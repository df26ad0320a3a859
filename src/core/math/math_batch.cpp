// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/math_batch.h"

#include "vegetation_sim/core/math/math.h"

// Vectors without arithmetic operators are left out; their processors use the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/math/math_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// Without vectors nothing is computed at once.
std::size_t sinCosOfMany(const double*, std::size_t, double*, double*) {
  return 0;
}
std::size_t cosTurnsOfMany(const double*, std::size_t, double*) {
  return 0;
}
std::size_t arcTangentOfMany(const double*, const double*, std::size_t, double*) {
  return 0;
}
#else
using Tag = hn::ScalableTag<double>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes all(double value) {
  return hn::Set(Tag(), value);
}

// The operations of math.cpp in their order.
HWY_INLINE Lanes sineLanes(Lanes x) {
  const Lanes x2 = x * x;
  Lanes s = all(1.0 / 355687428096000.0);
  s = s * x2 - all(1.0 / 1307674368000.0);
  s = s * x2 + all(1.0 / 6227020800.0);
  s = s * x2 - all(1.0 / 39916800.0);
  s = s * x2 + all(1.0 / 362880.0);
  s = s * x2 - all(1.0 / 5040.0);
  s = s * x2 + all(1.0 / 120.0);
  s = s * x2 - all(1.0 / 6.0);
  return x + x * (x2 * s);
}

HWY_INLINE Lanes cosineLanes(Lanes x) {
  const Lanes x2 = x * x;
  Lanes c = all(1.0 / 20922789888000.0);
  c = c * x2 - all(1.0 / 87178291200.0);
  c = c * x2 + all(1.0 / 479001600.0);
  c = c * x2 - all(1.0 / 3628800.0);
  c = c * x2 + all(1.0 / 40320.0);
  c = c * x2 - all(1.0 / 720.0);
  c = c * x2 + all(1.0 / 24.0);
  return all(1.0) - all(0.5) * x2 + x2 * x2 * c;
}

struct LanesSinCos {
  Lanes sin, cos;
};

// The sine and cosine of x plus a number of quarter turns.
HWY_INLINE LanesSinCos turnQuarters(Lanes x, Lanes quarters) {
  const Lanes s = sineLanes(x), c = cosineLanes(x);
  const Lanes turn = quarters - all(4.0) * hn::Floor(quarters * all(0.25));  // 0, 1, 2 or 3
  const auto second = turn == all(1.0), third = turn == all(2.0), fourth = turn == all(3.0);
  const auto swapped = hn::Or(second, fourth);
  const Lanes sin = hn::IfThenElse(swapped, c, s), cos = hn::IfThenElse(swapped, s, c);
  return {hn::IfThenElse(hn::Or(third, fourth), hn::Neg(sin), sin),
          hn::IfThenElse(hn::Or(second, third), hn::Neg(cos), cos)};
}

// Requires |angle| < 1e6.
HWY_INLINE LanesSinCos sinCosLanes(Lanes angle) {
  const Lanes quadrant = hn::Floor(angle * all(2.0 / PI) + all(0.5));
  const Lanes x = ((angle - quadrant * all(1.57079632673412561417e+00)) -
                   quadrant * all(6.07710050630396597660e-11)) -
                  quadrant * all(2.02226624879595063154e-21);
  return turnQuarters(x, quadrant);
}

HWY_INLINE Lanes cosTurnsLanes(Lanes turns) {
  const Lanes fraction = turns - hn::Floor(turns + all(0.5));
  const Lanes quarter = hn::Floor(fraction * all(4.0) + all(0.5));
  return turnQuarters((fraction - quarter * all(0.25)) * all(2.0 * PI), quarter).cos;
}

HWY_INLINE Lanes arcTangentLanes(Lanes y, Lanes x) {
  const Lanes zero = hn::Zero(Tag()), one = all(1.0);
  const Lanes ax = hn::Abs(x), ay = hn::Abs(y), big = hn::Max(ax, ay);
  const auto any = big > zero;
  const Lanes ratio = hn::IfThenElseZero(any, hn::Min(ax, ay) / big);
  const Lanes scale = hn::Sqrt(one + ratio * ratio), s = ratio / scale, c = one / scale;
  Lanes angle = ratio * (all(PI / 4.0) + all(0.273) * (one - ratio));
  for (int i = 0; i < 2; ++i) {
    const LanesSinCos guess = sinCosLanes(angle);
    angle = angle + (s * guess.cos - c * guess.sin);
  }
  angle = hn::IfThenElse(ay > ax, all(PI / 2.0) - angle, angle);
  angle = hn::IfThenElse(x < zero, all(PI) - angle, angle);
  angle = hn::IfThenElse(y < zero, hn::Neg(angle), angle);
  return hn::IfThenElseZero(any, angle);
}

// They return for how many numbers they have done it: whole vectors.
std::size_t sinCosOfMany(const double* angle, std::size_t count, double* sin, double* cos) {
  const Tag tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag)) {
    const Lanes a = hn::LoadU(tag, angle + i);
    if (!hn::AllTrue(tag, hn::Abs(a) < all(1e6))) return i;  // the rest is computed one by one
    const LanesSinCos out = sinCosLanes(a);
    hn::StoreU(out.sin, tag, sin + i);
    hn::StoreU(out.cos, tag, cos + i);
  }
  return i;
}

std::size_t cosTurnsOfMany(const double* turns, std::size_t count, double* cos) {
  const Tag tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag))
    hn::StoreU(cosTurnsLanes(hn::LoadU(tag, turns + i)), tag, cos + i);
  return i;
}

std::size_t arcTangentOfMany(const double* y, const double* x, std::size_t count, double* out) {
  const Tag tag;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag))
    hn::StoreU(arcTangentLanes(hn::LoadU(tag, y + i), hn::LoadU(tag, x + i)), tag, out + i);
  return i;
}
#endif

}  // namespace vegetation_sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim {

HWY_EXPORT(sinCosOfMany);
HWY_EXPORT(cosTurnsOfMany);
HWY_EXPORT(arcTangentOfMany);

void batchSinCos(const double* angle, std::size_t count, double* sin, double* cos) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(sinCosOfMany)(angle, count, sin, cos);
  for (; i < count; ++i) {
    const SinCos out = sinCos(angle[i]);
    sin[i] = out.sin;
    cos[i] = out.cos;
  }
}

void batchCosTurns(const double* turns, std::size_t count, double* cos) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(cosTurnsOfMany)(turns, count, cos);
  for (; i < count; ++i) cos[i] = sinCosTurns(turns[i]).cos;
}

void batchArcTangent(const double* y, const double* x, std::size_t count, double* out) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(arcTangentOfMany)(y, x, count, out);
  for (; i < count; ++i) out[i] = arcTangent(y[i], x[i]);
}

}  // namespace vegetation_sim
#endif

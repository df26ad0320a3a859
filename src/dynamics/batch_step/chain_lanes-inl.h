// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Vectors, rotations and inertias on lanes of floats. Included once per instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_LANES_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_LANES_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "dynamics/batch_step/chain_rows.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, ROW>;
using Lanes = hn::Vec<Tag>;

struct Lanes3 {
  Lanes x, y, z;
};

struct LanesQuat {
  Lanes w, x, y, z;
};

struct Symmetric {
  Lanes xx, xy, xz, yy, yz, zz;
};

HWY_INLINE Lanes all(float value) {
  return hn::Set(Tag(), value);
}

// `stride` is the number of floats from one row to the next.
HWY_INLINE Lanes load(const float* rows, int row, int stride = ROW) {
  return hn::LoadU(Tag(), rows + row * stride);
}

HWY_INLINE Lanes3 load3(const float* rows, int row, int stride = ROW) {
  return {load(rows, row, stride), load(rows, row + 1, stride), load(rows, row + 2, stride)};
}

HWY_INLINE Symmetric load6(const float* rows, int row) {
  return {load(rows, row),     load(rows, row + 1), load(rows, row + 2),
          load(rows, row + 3), load(rows, row + 4), load(rows, row + 5)};
}

HWY_INLINE void store(Lanes value, float* rows, int row, int stride = ROW) {
  hn::StoreU(value, Tag(), rows + row * stride);
}

HWY_INLINE void store3(const Lanes3& value, float* rows, int row, int stride = ROW) {
  store(value.x, rows, row, stride);
  store(value.y, rows, row + 1, stride);
  store(value.z, rows, row + 2, stride);
}

HWY_INLINE void store6(const Symmetric& value, float* rows, int row, int stride = ROW) {
  store3({value.xx, value.xy, value.xz}, rows, row, stride);
  store3({value.yy, value.yz, value.zz}, rows, row + 3, stride);
}

HWY_INLINE Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

HWY_INLINE Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

HWY_INLINE Lanes3 operator*(Lanes s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}

HWY_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

HWY_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

HWY_INLINE Lanes3 operator*(const Symmetric& a, const Lanes3& v) {
  return {(a.xx * v.x + a.xy * v.y) + a.xz * v.z, (a.xy * v.x + a.yy * v.y) + a.yz * v.z,
          (a.xz * v.x + a.yz * v.y) + a.zz * v.z};
}

HWY_INLINE Symmetric operator+(const Symmetric& a, const Symmetric& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

// Returns a - p u u^T - q v v^T, with p u and q v given.
HWY_INLINE Symmetric without(const Symmetric& a, const Lanes3& pu, const Lanes3& u,
                             const Lanes3& qv, const Lanes3& v) {
  return {a.xx - pu.x * u.x - qv.x * v.x, a.xy - pu.x * u.y - qv.x * v.y,
          a.xz - pu.x * u.z - qv.x * v.z, a.yy - pu.y * u.y - qv.y * v.y,
          a.yz - pu.y * u.z - qv.y * v.z, a.zz - pu.z * u.z - qv.z * v.z};
}

HWY_INLINE LanesQuat operator*(const LanesQuat& a, const LanesQuat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// Axes of a rotated frame, world.
struct Axes {
  Lanes3 x, y, z;
};

HWY_INLINE Axes axesOf(const LanesQuat& q) {
  const Lanes one = all(1.f), x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const Lanes xx = x2 * q.x, xy = x2 * q.y, xz = x2 * q.z, yy = y2 * q.y, yz = y2 * q.z,
              zz = z2 * q.z, wx = x2 * q.w, wy = y2 * q.w, wz = z2 * q.w;
  return {{one - (yy + zz), xy + wz, xz - wy},
          {xy - wz, one - (xx + zz), yz + wx},
          {xz + wy, yz - wx, one - (xx + yy)}};
}

HWY_INLINE Lanes3 turned(const Axes& axes, const Lanes3& v) {
  return v.x * axes.x + v.y * axes.y + v.z * axes.z;
}

// Returns R a R^T.
HWY_INLINE Symmetric turnedInertia(const Axes& r, const Symmetric& a) {
  const Lanes3 x = turned(r, {a.xx, a.xy, a.xz}), y = turned(r, {a.xy, a.yy, a.yz}),
               z = turned(r, {a.xz, a.yz, a.zz});
  return {x.x * r.x.x + y.x * r.y.x + z.x * r.z.x, x.x * r.x.y + y.x * r.y.y + z.x * r.z.y,
          x.x * r.x.z + y.x * r.y.z + z.x * r.z.z, x.y * r.x.y + y.y * r.y.y + z.y * r.z.y,
          x.y * r.x.z + y.y * r.y.z + z.y * r.z.z, x.z * r.x.z + y.z * r.y.z + z.z * r.z.z};
}

// Series of the rotation vector of size a: cos(a/2), sin(a/2) / (a/2), b = (1 - cos a) / a^2, c =
// (a - sin a) / a^3 and the derivatives of b and c by a, divided by a.
struct RotationSeries {
  Lanes w, s, b, c, db, dc;
};

// Taylor series for a <= 1: relative errors below 2e-7, those of the derivatives 1e-6.
HWY_INLINE RotationSeries smallRotation(Lanes a2) {
  const Lanes u = all(0.25f) * a2;
  RotationSeries out;
  out.s = ((all(-1.f / 5040.f) * u + all(1.f / 120.f)) * u - all(1.f / 6.f)) * u + all(1.f);
  out.w = (all(1.f / 40320.f) * u - all(1.f / 720.f)) * u + all(1.f / 24.f);
  out.w = (out.w * u - all(0.5f)) * u + all(1.f);
  out.b = all(0.5f) * out.s * out.s;
  out.c = ((all(-1.f / 362880.f) * a2 + all(1.f / 5040.f)) * a2 - all(1.f / 120.f)) * a2 +
          all(1.f / 6.f);
  out.db = ((all(1.f / 453600.f) * a2 - all(1.f / 6720.f)) * a2 + all(1.f / 180.f)) * a2 -
           all(1.f / 12.f);
  out.dc = (all(-1.f / 60480.f) * a2 + all(1.f / 1260.f)) * a2 - all(1.f / 60.f);
  return out;
}

// For a > 1: subtracts whole half turns from the half angle, then uses the Taylor series.
inline HWY_NOINLINE RotationSeries largeRotation(Lanes a2) {
  const Lanes half = all(0.5f) * hn::Sqrt(a2), one = all(1.f);
  const Lanes n = hn::Round(half * all(0.318309886183790672f));
  const Lanes r = (half - n * all(3.140625f)) - n * all(9.6765358979323846e-4f);
  const Lanes odd = hn::Abs(n - all(2.f) * hn::Round(all(0.5f) * n)), sign = one - odd - odd;
  const Lanes u = r * r;
  Lanes s = all(1.f / 6227020800.f) * u - all(1.f / 39916800.f);
  s = ((s * u + all(1.f / 362880.f)) * u - all(1.f / 5040.f)) * u + all(1.f / 120.f);
  s = (s * u - all(1.f / 6.f)) * u + one;
  Lanes w = all(-1.f / 3628800.f) + u * all(1.f / 479001600.f);
  w = ((w * u + all(1.f / 40320.f)) * u - all(1.f / 720.f)) * u + all(1.f / 24.f);
  w = (w * u - all(0.5f)) * u + one;
  RotationSeries out;
  out.w = sign * w;
  out.s = sign * (s * r) / half;
  const Lanes inverse = one / a2, whole = out.s * out.w;  // whole: sin a / a
  out.b = all(0.5f) * out.s * out.s;
  out.c = (one - whole) * inverse;
  out.db = (whole - out.b - out.b) * inverse;
  out.dc = (out.b - all(3.f) * out.c) * inverse;
  return out;
}

HWY_INLINE RotationSeries rotationSeries(Lanes a2) {
  RotationSeries out = smallRotation(a2);
  const auto large = a2 > all(1.f);
  if (HWY_LIKELY(hn::AllFalse(Tag(), large))) return out;
  const RotationSeries other = largeRotation(hn::Max(a2, all(1.f)));
  out.w = hn::IfThenElse(large, other.w, out.w);
  out.s = hn::IfThenElse(large, other.s, out.s);
  out.b = hn::IfThenElse(large, other.b, out.b);
  out.c = hn::IfThenElse(large, other.c, out.c);
  out.db = hn::IfThenElse(large, other.db, out.db);
  out.dc = hn::IfThenElse(large, other.dc, out.dc);
  return out;
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle

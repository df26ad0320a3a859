// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Joint rotations on vectors of floats; included once per instruction set.

#if defined(VEGETATION_SIM_FOREST_BATCH_JOINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_FOREST_BATCH_JOINT_INL_H_
#undef VEGETATION_SIM_FOREST_BATCH_JOINT_INL_H_
#else
#define VEGETATION_SIM_FOREST_BATCH_JOINT_INL_H_
#endif

#include "vegetation_sim/tree/growth/response.h"
#include "wind/sampling/batch_wind-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

struct LanesQuat {
  Lanes w, x, y, z;
};

HWY_INLINE LanesQuat multiply(const LanesQuat& a, const LanesQuat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// sin(h) / h and cos(h) from u = h^2 <= 0.36: Taylor, errors 2e-10 and 2e-9.
HWY_INLINE Lanes sinc(Lanes u) {
  Lanes s = all(1.f / 362880.f);
  s = s * u - all(1.f / 5040.f);
  s = s * u + all(1.f / 120.f);
  s = s * u - all(1.f / 6.f);
  return s * u + all(1.f);
}

HWY_INLINE Lanes cosine(Lanes u) {
  Lanes c = all(1.f / 40320.f);
  c = c * u - all(1.f / 720.f);
  c = c * u + all(1.f / 24.f);
  c = c * u - all(0.5f);
  return c * u + all(1.f);
}

// Factor that bounds an angle of this size squared: 1 up to the knee (softLimit of common/math.h).
HWY_INLINE Lanes limitFactor(Lanes squared) {
  const Lanes knee = all(static_cast<float>(BEND_KNEE));
  const auto over = squared > knee * knee;
  if (hn::AllFalse(Tag(), over)) return all(1.f);  // the usual case: no root, no division
  const Lanes magnitude = hn::Sqrt(squared);
  const Lanes room = all(static_cast<float>(BEND_LIMIT - BEND_KNEE));
  const Lanes excess = (magnitude - knee) / room;
  const Lanes bounded = knee + room * (excess / hn::Sqrt(all(1.f) + excess * excess));
  return hn::IfThenElse(over, bounded / magnitude, all(1.f));
}

// Rest rotation, then a bend by (a, b) about the own x and y.
HWY_INLINE LanesQuat swingJoint(const LanesQuat& rest, Lanes a, Lanes b, Lanes weight) {
  const Lanes factor = weight * limitFactor(a * a + b * b);
  a = a * factor;
  b = b * factor;
  const Lanes u = all(0.25f) * (a * a + b * b);
  const Lanes s = all(0.5f) * sinc(u), w = cosine(u), x = s * a, y = s * b;
  return {rest.w * w - rest.x * x - rest.y * y, rest.w * x + rest.x * w - rest.z * y,
          rest.w * y + rest.y * w + rest.z * x, rest.z * w + rest.x * y - rest.y * x};
}

struct HalfAngle {
  Lanes cos, sin;
};

// Half of a rest angle plus half of a bounded deviation.
HWY_INLINE HalfAngle turned(Lanes cos0, Lanes sin0, Lanes angle, Lanes weight) {
  const Lanes half = all(0.5f) * angle * (weight * limitFactor(angle * angle));
  const Lanes u = half * half, s = half * sinc(u), c = cosine(u);
  return {cos0 * c - sin0 * s, sin0 * c + cos0 * s};
}

// Rz(theta) Ry(phi); rest holds cos, sin of theta / 2 and of phi / 2.
HWY_INLINE LanesQuat paperJoint(const LanesQuat& rest, Lanes a, Lanes b, Lanes weight) {
  const HalfAngle t = turned(rest.w, rest.x, a, weight), p = turned(rest.y, rest.z, b, weight);
  return {t.cos * p.cos, hn::Zero(Tag()) - t.sin * p.sin, t.cos * p.sin, t.sin * p.cos};
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The wind law of wind::Instant::velocity on vectors of floats; this file is included once per
// instruction set.

#if defined(VEGETATION_SIM_FOREST_BATCH_WIND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_FOREST_BATCH_WIND_INL_H_
#undef VEGETATION_SIM_FOREST_BATCH_WIND_INL_H_
#else
#define VEGETATION_SIM_FOREST_BATCH_WIND_INL_H_
#endif

#include <hwy/highway.h>

#include "wind/laws.h"
#include "wind/sampling/batch_wind.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Lanes = hn::Vec<Tag>;
using BitsTag = hn::RebindToSigned<Tag>;

struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes all(float value) {
  return hn::Set(Tag(), value);
}

HWY_INLINE Lanes saturate(Lanes x) {
  return hn::Min(all(1.f), hn::Max(hn::Zero(Tag()), x));
}

HWY_INLINE Lanes smootherStep(Lanes x) {
  const Lanes u = saturate(x);
  return u * u * u * (u * (all(6.f) * u - all(15.f)) + all(10.f));
}

HWY_INLINE Lanes envelope(bool smooth, Lanes x) {
  return smooth ? smootherStep(x) : saturate(x);
}

// Returns cos(2 pi u). It drops whole turns, then computes sin(2 pi (1/4 - |u|)) by the odd
// polynomial to t^9 of least maximal error (3e-9, with rounding 2.1e-7). The polynomial is summed
// by pairs for a short chain of dependencies.
HWY_INLINE Lanes cosTurns(Lanes u) {
  const Lanes t = all(0.25f) - hn::Abs(u - hn::Round(u)), t2 = t * t, t4 = t2 * t2;
  const Lanes low = all(6.283185160089465f) - all(41.34165503141383f) * t2;
  const Lanes high = all(81.6010040731224f) - all(76.5497822905063f) * t2;
  return t * (low + t4 * (high + t4 * all(39.53670604288345f)));
}

HWY_INLINE void add(Lanes3& v, Lanes factor, float x, float y, float z) {
  v.x = v.x + factor * all(x);
  v.y = v.y + factor * all(y);
  v.z = v.z + factor * all(z);
}

HWY_INLINE void addMode(const FloatMode& m, const Lanes3& p, Lanes3& v) {
  const Lanes turns = (all(m.wx) * p.x + all(m.wy) * p.y) + (all(m.wz) * p.z + all(m.phase));
  add(v, cosTurns(turns), m.vx, m.vy, m.vz);
}

HWY_INLINE void addDisk(const FloatTerm& t, Lanes dx, Lanes dy, Lanes3& v) {
  const Lanes d = hn::Sqrt(dx * dx + dy * dy);
  add(v, envelope(t.smooth, all(1.f) - d * all(t.inverse_radius)), t.vx, t.vy, t.vz);
}

HWY_INLINE void addGust(const FloatTerm& t, Lanes dx, Lanes dy, Lanes3& v) {
  const Lanes behind = hn::Zero(Tag()) - (dx * all(t.nx) + dy * all(t.ny));
  const Lanes beside = hn::Abs(dy * all(t.nx) - dx * all(t.ny));
  const Lanes rise = smootherStep(behind * all(t.rise));
  const Lanes past = behind - all(1.f / t.rise) - all(t.plateau);
  const Lanes decay = all(1.f) - smootherStep(past * all(t.decay));
  const Lanes across = envelope(t.smooth, all(1.f) - beside * all(t.inverse_radius));
  add(v, rise * decay * across, t.vx, t.vy, t.vz);
}

// Returns 2 / (1 + rho^2) / core, which times the distance peaks at 1 on the core radius.
HWY_INLINE Lanes vortex(const FloatTerm& t, Lanes d2) {
  const Lanes core = all(t.inverse_core);
  return all(2.f) * core / (all(1.f) + d2 * core * core);
}

HWY_INLINE void addTornado(const FloatTerm& t, Lanes dx, Lanes dy, Lanes3& v) {
  const Lanes d2 = dx * dx + dy * dy, d = hn::Sqrt(d2);
  const Lanes inside = all(1.f) - d * all(t.inverse_radius);
  const Lanes strength = all(t.speed) * smootherStep(inside);
  const Lanes swirl = strength * vortex(t, d2), inflow = swirl * all(t.inflow);
  const Lanes core = all(t.inverse_core);
  v.x = v.x - swirl * dy - inflow * dx;
  v.y = v.y + swirl * dx - inflow * dy;
  v.z = v.z + strength * all(t.updraft) / (all(1.f) + d2 * core * core);
}

HWY_INLINE void addBlast(const FloatTerm& t, Lanes dx, Lanes dy, Lanes dz, Lanes3& v) {
  const Lanes d2 = dx * dx + dy * dy + dz * dz;
  const Lanes inside = all(1.f) - hn::Sqrt(d2) * all(t.inverse_radius);
  const Lanes out = all(t.speed) * vortex(t, d2) * smootherStep(inside);
  v.x = v.x + out * dx;
  v.y = v.y + out * dy;
  v.z = v.z + out * dz;
}

// Returns e^-x on [0, 9] with a relative error of 3e-7: e^-x = 2^-n e^(n ln 2 - x), a Taylor series
// on |n ln 2 - x| <= ln 2 / 2. n ln 2 is computed in two parts.
HWY_INLINE Lanes decayOf(Lanes x) {
  const Lanes n = hn::Round(x * all(1.44269504f));
  const Lanes r = (n * all(0.693145752f) - x) + n * all(1.42860677e-06f);
  const Lanes low = (all(1.f) + r) + (r * r) * (all(0.5f) + r * all(1.f / 6.f));
  const Lanes high = all(1.f / 24.f) + r * (all(1.f / 120.f) + r * all(1.f / 720.f));
  const auto exponent = hn::Set(BitsTag(), 127) - hn::ConvertTo(BitsTag(), n);
  const Lanes power = hn::BitCast(Tag(), hn::ShiftLeft<23>(exponent));
  return power * (low + (r * r) * (r * r) * high);
}

// Returns x^(-1/3) of positive numbers with a relative error of 3e-7. A third of the exponent is
// within 4 %, and each of Newton's steps squares the error and doubles it.
HWY_INLINE Lanes inverseCubeRoot(Lanes x) {
  const Lanes bits = hn::ConvertTo(Tag(), hn::BitCast(BitsTag(), x));
  const auto third = hn::ConvertTo(BitsTag(), bits * all(1.f / 3.f));
  Lanes y = hn::BitCast(Tag(), hn::Set(BitsTag(), 0x54A2FA8C) - third);
  for (int i = 0; i < 3; ++i) y = y * (all(4.f / 3.f) - all(1.f / 3.f) * (x * y * y * y));
  return y;
}

HWY_INLINE void addWake(const FloatTerm& t, Lanes dx, Lanes dy, Lanes dz, Lanes3& v) {
  constexpr float EDGE = static_cast<float>(wind::WAKE_EDGE);
  constexpr float SPREAD = static_cast<float>(wind::WAKE_SPREAD);
  const Lanes behind = hn::Zero(Tag()) - (dx * all(t.nx) + dy * all(t.ny));
  const Lanes beside = dy * all(t.nx) - dx * all(t.ny);
  const Lanes radii = hn::Max(behind * all(t.inverse_radius), all(-1.f));
  const Lanes narrowing = inverseCubeRoot(all(1.f) + radii * all(1.f / SPREAD));
  const Lanes b = hn::Sqrt(beside * beside + dz * dz) * all(t.inverse_radius);
  const Lanes widths = hn::Min(b * narrowing, all(EDGE));
  const Lanes across =
      decayOf(widths * widths) * (all(1.f) - smootherStep(widths - all(EDGE - 1.f)));
  const Lanes end = all(1.f) - smootherStep((behind - all(t.plateau)) * all(t.decay));
  const Lanes along = smootherStep(radii + all(1.f)) * end;
  add(v, along * (narrowing * narrowing) * across, t.vx, t.vy, t.vz);
}

HWY_INLINE Lanes3 windAt(const FloatWind& wind, const Lanes3& p) {
  Lanes3 v{all(wind.vx), all(wind.vy), all(wind.vz)};
  for (const FloatMode& mode : wind.modes) addMode(mode, p, v);
  for (const FloatTerm& t : wind.terms) {
    const Lanes dx = p.x - all(t.x), dy = p.y - all(t.y);
    switch (t.kind) {
      case wind::Kind::DISK:
        addDisk(t, dx, dy, v);
        break;
      case wind::Kind::GUST:
        addGust(t, dx, dy, v);
        break;
      case wind::Kind::TORNADO:
        addTornado(t, dx, dy, v);
        break;
      case wind::Kind::BLAST:
        addBlast(t, dx, dy, p.z - all(t.z), v);
        break;
      case wind::Kind::WAKE:
        addWake(t, dx, dy, p.z - all(t.z), v);
        break;
      case wind::Kind::BREEZE:
        break;  // part of mean and modes
      case wind::Kind::GAUSS_MARKOV:
        break;  // its terms are disks
    }
  }
  return v;
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle

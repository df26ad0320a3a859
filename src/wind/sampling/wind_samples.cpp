// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/sampling/wind_samples.h"

#include "vegetation_sim/core/math/math.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wind/sampling/wind_samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::wind::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<double>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes all(double value) {
  return hn::Set(Tag(), value);
}

// This is the series of core/math/math.h.
HWY_INLINE Lanes sineSeries(Lanes x, Lanes x2) {
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

HWY_INLINE Lanes cosineSeries(Lanes x2) {
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

// Repeats every operation of sinCosTurns of core/math/math.h.
HWY_INLINE LanesSinCos sinCosTurns(Lanes turns) {
  const Lanes fraction = turns - hn::Floor(turns + all(0.5));
  const Lanes quarter = hn::Floor(fraction * all(4.0) + all(0.5));
  const Lanes x = (fraction - quarter * all(0.25)) * all(2.0 * PI), x2 = x * x;
  const Lanes s = sineSeries(x, x2), c = cosineSeries(x2);
  const auto middle = quarter == hn::Zero(Tag()), left = quarter == all(-1.0);
  const auto right = quarter == all(1.0), odd = hn::Or(left, right);
  const Lanes sin = hn::IfThenElse(odd, c, s), cos = hn::IfThenElse(odd, s, c);
  return {hn::IfThenElse(hn::Or(middle, right), sin, hn::Neg(sin)),
          hn::IfThenElse(hn::Or(middle, left), cos, hn::Neg(cos))};
}

struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 load(const WindSamples& rows, std::size_t i) {
  return {hn::LoadU(Tag(), rows.x + i), hn::LoadU(Tag(), rows.y + i), hn::LoadU(Tag(), rows.z + i)};
}

HWY_INLINE Lanes turnsOf(const Mode& m, const Lanes3& p) {
  return (all(m.wave.x()) * p.x + all(m.wave.y()) * p.y) + all(m.wave.z()) * p.z + all(m.phase);
}

HWY_INLINE void add(const Mode& m, Lanes factor, Lanes3& v) {
  v.x = v.x + all(m.amplitude.x()) * factor;
  v.y = v.y + all(m.amplitude.y()) * factor;
  v.z = v.z + all(m.amplitude.z()) * factor;
}

HWY_INLINE void store(const Lanes3& v, const WindSamples& rows, std::size_t i) {
  hn::StoreU(v.x, Tag(), rows.vx + i);
  hn::StoreU(v.y, Tag(), rows.vy + i);
  hn::StoreU(v.z, Tag(), rows.vz + i);
}

HWY_INLINE Lanes3 mean(const Instant& wind) {
  return {all(wind.mean.x()), all(wind.mean.y()), all(wind.mean.z())};
}

// Two vectors alternate, because a single one would wait for its own series.
void sampleRows(const Instant& wind, const WindSamples& rows) {
  const std::size_t width = hn::Lanes(Tag());
  for (std::size_t i = 0; i < rows.count; i += 2 * width) {
    const Lanes3 p = load(rows, i), q = load(rows, i + width);
    Lanes3 v = mean(wind), w = v;
    for (const Mode& m : wind.modes) {
      const Lanes a = sinCosTurns(turnsOf(m, p)).cos, b = sinCosTurns(turnsOf(m, q)).cos;
      add(m, a, v);
      add(m, b, w);
    }
    store(v, rows, i);
    store(w, rows, i + width);
  }
}

void sampleInstants(const std::array<Instant, 3>& instants,
                    const std::array<std::vector<SinCos>, 2>& turns,
                    const std::array<WindSamples, 3>& rows) {
  const std::size_t width = hn::Lanes(Tag());
  for (std::size_t i = 0; i < rows[1].count; i += width) {
    const Lanes3 p = load(rows[1], i);
    Lanes3 before = mean(instants[0]), now = mean(instants[1]), after = mean(instants[2]);
    for (std::size_t m = 0; m < instants[1].modes.size(); ++m) {
      const LanesSinCos at = sinCosTurns(turnsOf(instants[1].modes[m], p));
      const SinCos &to_before = turns[0][m], &to_after = turns[1][m];
      add(instants[0].modes[m], at.cos * all(to_before.cos) - at.sin * all(to_before.sin), before);
      add(instants[1].modes[m], at.cos, now);
      add(instants[2].modes[m], at.cos * all(to_after.cos) - at.sin * all(to_after.sin), after);
    }
    store(before, rows[0], i);
    store(now, rows[1], i);
    store(after, rows[2], i);
  }
}

}  // namespace
}  // namespace vegetation_sim::wind::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::wind {

HWY_EXPORT(sampleRows);
HWY_EXPORT(sampleInstants);

void sampleBreeze(const Instant& wind, const WindSamples& rows) {
  HWY_DYNAMIC_DISPATCH(sampleRows)(wind, rows);
}

void sampleBreeze(const std::array<Instant, 3>& instants,
                  const std::array<std::vector<SinCos>, 2>& turns,
                  const std::array<WindSamples, 3>& rows) {
  HWY_DYNAMIC_DISPATCH(sampleInstants)(instants, turns, rows);
}

}  // namespace vegetation_sim::wind
#endif

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of blade_plain.cpp and blade_profile.cpp on vectors of floats, operation by
// operation; included once per instruction set.

#if defined(VEGETATION_SIM_GRASS_BLADE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_GRASS_BLADE_LANES_INL_H_
#undef VEGETATION_SIM_GRASS_BLADE_LANES_INL_H_
#else
#define VEGETATION_SIM_GRASS_BLADE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "grass/blades/blade_placement.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, BLOCK>;
using WordTag = hn::RebindToUnsigned<Tag>;
using IndexTag = hn::RebindToSigned<Tag>;
using Lanes = hn::Vec<Tag>;
using Words = hn::Vec<WordTag>;
using Indices = hn::Vec<IndexTag>;

HWY_INLINE Lanes all(float value) {
  return hn::Set(Tag(), value);
}

struct LanesSineCosine {
  Lanes sin, cos;
};

HWY_INLINE LanesSineCosine sineCosine(Lanes x) {
  const Lanes u = x * x;
  Lanes s = all(static_cast<float>(-1.0 / 39916800.0));
  s = s * u + all(static_cast<float>(1.0 / 362880.0));
  s = s * u - all(static_cast<float>(1.0 / 5040.0));
  s = s * u + all(static_cast<float>(1.0 / 120.0));
  s = s * u - all(static_cast<float>(1.0 / 6.0));
  Lanes c = all(static_cast<float>(1.0 / 479001600.0));
  c = c * u - all(static_cast<float>(1.0 / 3628800.0));
  c = c * u + all(static_cast<float>(1.0 / 40320.0));
  c = c * u - all(static_cast<float>(1.0 / 720.0));
  c = c * u + all(static_cast<float>(1.0 / 24.0));
  c = c * u - all(0.5f);
  return {x + x * (u * s), all(1.f) + u * c};
}

HWY_INLINE LanesSineCosine smallSineCosine(Lanes x) {
  const Lanes u = x * x;
  Lanes s = all(static_cast<float>(1.0 / 120.0));
  s = s * u - all(static_cast<float>(1.0 / 6.0));
  Lanes c = all(static_cast<float>(-1.0 / 720.0));
  c = c * u + all(static_cast<float>(1.0 / 24.0));
  c = c * u - all(0.5f);
  return {x + x * (u * s), all(1.f) + u * c};
}

// ---- random words ----------------------------------------------------------------------------

// mix32 of core/math/random.h on vectors.
HWY_INLINE Words mixLanes(Words x) {
  const WordTag tag;
  x = hn::Xor(x, hn::ShiftRight<16>(x));
  x = x * hn::Set(tag, 0x7FEB352DU);
  x = hn::Xor(x, hn::ShiftRight<15>(x));
  x = x * hn::Set(tag, 0x846CA68BU);
  return hn::Xor(x, hn::ShiftRight<16>(x));
}

HWY_INLINE Words wordLanes(Words base, std::uint32_t i) {
  return mixLanes(base + hn::Set(WordTag(), i * WORD_STEP));
}

HWY_INLINE Lanes toLanes(Words small) {
  return hn::ConvertTo(Tag(), hn::BitCast(IndexTag(), small));
}

// BladeRandom of these blades: the base of their words, and the numbers that select the species.
HWY_INLINE Words baseLanes(std::uint64_t key, Words blade) {
  const WordTag tag;
  return mixLanes(hn::Xor(blade, hn::Set(tag, static_cast<std::uint32_t>(key)))) +
         hn::Set(tag, static_cast<std::uint32_t>(key >> 32));
}

HWY_INLINE Lanes kindLanes(Words base) {
  return (toLanes(hn::ShiftRight<8>(wordLanes(base, 3))) + all(0.5f)) *
         all(static_cast<float>(1.0 / 16777216.0));
}

// ---- bilinear values -------------------------------------------------------------------------

HWY_INLINE Lanes linearPlace(Lanes chance, Lanes a, Lanes b) {
  const Lanes zero = hn::Zero(Tag());
  const Lanes root = hn::Sqrt(hn::Max(zero, a * a + (b - a) * (b + a) * chance));
  const Lanes below = a + root;
  const Lanes place = hn::IfThenElse(below > zero, chance * (a + b) / below, chance);
  return hn::Min(place, all(static_cast<float>(1.0 - 1.0 / 16777216.0)));
}

HWY_INLINE Lanes at(const Bilinear<float>& f, Lanes u, Lanes v) {
  return (all(f.base) + all(f.by_u) * u) + v * (all(f.by_v) + all(f.by_uv) * u);
}

// Place of (u, v) in a grid of cells.
struct LanesCell {
  Indices index;
  Lanes p, q;
  int side;
};

HWY_INLINE LanesCell cellAt(Lanes u, Lanes v, int cells) {
  const IndexTag tag;
  const Lanes a = u * all(static_cast<float>(cells)), b = v * all(static_cast<float>(cells));
  const Indices last = hn::Set(tag, cells - 1);
  const Indices column = hn::Min(hn::ConvertTo(tag, a), last);
  const Indices row = hn::Min(hn::ConvertTo(tag, b), last);
  return {row * hn::Set(tag, cells + 1) + column, a - hn::ConvertTo(Tag(), column),
          b - hn::ConvertTo(Tag(), row), cells + 1};
}

// Values at the four corners of a cell.
struct LanesCorners {
  Lanes low0, low1, high0, high1;
};

HWY_INLINE LanesCorners gather(const LanesCell& c, const std::vector<float>& grid) {
  const float* low = grid.data();
  const float* high = low + c.side;
  return {hn::GatherIndex(Tag(), low, c.index), hn::GatherIndex(Tag(), low + 1, c.index),
          hn::GatherIndex(Tag(), high, c.index), hn::GatherIndex(Tag(), high + 1, c.index)};
}

HWY_INLINE Lanes interpolate(const LanesCell& c, const LanesCorners& g) {
  const Lanes one = all(1.f);
  return (g.low0 * (one - c.p) + g.low1 * c.p) * (one - c.q) +
         (g.high0 * (one - c.p) + g.high1 * c.p) * c.q;
}

// CrushPatch::nearest().
HWY_INLINE Indices nearestAt(Lanes u, Lanes v, int cells) {
  const Lanes n = all(static_cast<float>(cells)), half = all(0.5f);
  const IndexTag tag;
  return hn::ConvertTo(tag, v * n + half) * hn::Set(tag, cells + 1) +
         hn::ConvertTo(tag, u * n + half);
}

// ---- profile ---------------------------------------------------------------------------------

struct LanesProfile {
  Lanes reach[POINTS], rise[POINTS];
};

HWY_INLINE void arcProfile(Lanes length, Lanes hinge, Lanes arc, bool upright, LanesProfile& out) {
  const LanesSineCosine half = smallSineCosine(arc * all(static_cast<float>(0.5 / LINKS)));
  const Lanes twice = all(2.f) - all(4.f) * half.sin * half.sin;
  const Lanes link = length * all(static_cast<float>(1.0 / LINKS));
  const Lanes ls = link * half.sin, lc = link * half.cos;
  Lanes s = ls, s_before = hn::Zero(Tag()) - ls;  // equal to the bits of a hinge of 0
  Lanes c = lc, c_before = lc;
  if (!upright) {
    const LanesSineCosine root = sineCosine(hinge);
    s = root.sin * lc + root.cos * ls;
    s_before = root.sin * lc - root.cos * ls;
    c = root.cos * lc - root.sin * ls;
    c_before = root.cos * lc + root.sin * ls;
  }
  out.reach[0] = out.rise[0] = hn::Zero(Tag());
  for (int i = 0; i < LINKS; ++i) {
    out.reach[i + 1] = out.reach[i] + s;
    out.rise[i + 1] = out.rise[i] + c;
    const Lanes s_next = twice * s - s_before, c_next = twice * c - c_before;
    s_before = s;
    c_before = c;
    s = s_next;
    c = c_next;
  }
}

HWY_INLINE void paperProfile(Lanes length, Lanes hinge, Lanes arc, LanesProfile& out) {
  const Lanes zero = hn::Zero(Tag());
  const Lanes x = length * sineCosine(hinge + all(0.5f) * arc).sin;
  const Lanes z = hn::Sqrt(hn::Max(zero, length * length - x * x));
  out.reach[0] = out.rise[0] = zero;
  for (int i = 1; i < POINTS; ++i) {
    const float s = static_cast<float>(i) * static_cast<float>(1.0 / LINKS), square = s * s;
    out.reach[i] = all(square) * x;
    out.rise[i] = all(square) * z + all(s - square) * length;
  }
}

}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle

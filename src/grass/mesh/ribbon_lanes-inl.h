// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of ribbons_plain.cpp on vectors of floats, operation by operation; included once
// per instruction set.

#if defined(VEGETATION_SIM_GRASS_RIBBON_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_GRASS_RIBBON_LANES_INL_H_
#undef VEGETATION_SIM_GRASS_RIBBON_LANES_INL_H_
#else
#define VEGETATION_SIM_GRASS_RIBBON_LANES_INL_H_
#endif

#include "grass/blades/blade_lanes-inl.h"
#include "grass/mesh/ribbon_plan.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {

struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 all3(const Float3& v) {
  return {all(v.x), all(v.y), all(v.z)};
}

HWY_INLINE Lanes3 sum(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

HWY_INLINE Lanes3 difference(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

HWY_INLINE Lanes3 scaled(const Lanes3& a, Lanes s) {
  return {a.x * s, a.y * s, a.z * s};
}

HWY_INLINE Lanes unitOf(Lanes x) {
  return hn::Min(all(1.f), hn::Max(hn::Zero(Tag()), x));
}

HWY_INLINE Lanes3 sideLanes(const Lanes3& along, const Lanes3& view) {
  const Lanes3 c{along.y * view.z - along.z * view.y, along.z * view.x - along.x * view.z,
                 along.x * view.y - along.y * view.x};
  const Lanes square = c.x * c.x + c.y * c.y + c.z * c.z, one = all(1.f);
  const Lanes inverse = one / hn::Sqrt(square);
  const auto any = square > all(1e-20f);
  return {hn::IfThenElse(any, c.x * inverse, one), hn::IfThenElseZero(any, c.y * inverse),
          hn::IfThenElseZero(any, c.z * inverse)};
}

// Moves of the roots towards the nearest edges of their tile.
HWY_INLINE Lanes3 slideLanes(Lanes x, Lanes y, float size, float slide) {
  const Lanes east = all(size) - x, north = all(size) - y;
  const Lanes least = hn::Min(hn::Min(x, east), hn::Min(y, north));
  const auto west_least = x == least, east_least = east == least;
  const Lanes dx = hn::IfThenElse(west_least, hn::Neg(x), hn::IfThenElseZero(east_least, east));
  const Lanes dy = hn::IfThenZeroElse(hn::Or(west_least, east_least),
                                      hn::IfThenElse(y == least, hn::Neg(y), north));
  return scaled({dx, dy, hn::Zero(Tag())}, all(slide));
}

struct LanesLook {
  Lanes3 fresh, drying;
  Lanes half, flower, kind;
};

HWY_INLINE LanesLook lookLanes(const RibbonPlan& p, Words blade, Lanes u, Lanes v) {
  const RibbonLook& first = p.looks[0];
  LanesLook out{all3(first.fresh), all3(first.drying), all(first.half), all(first.flower),
                hn::Zero(Tag())};
  if (!p.plan.mixed) return out;
  const auto last = static_cast<std::size_t>(p.tile.species_count - 1);
  const Lanes aim = kindLanes(baseLanes(p.tile.key, blade)) * at(p.plan.shares[last], u, v);
  for (std::size_t s = 1; s <= last; ++s) {
    const auto beyond = aim > at(p.plan.shares[s - 1], u, v);
    const RibbonLook& look = p.looks[s];
    const auto choose = [&](float to, Lanes& value)
                            HWY_ATTR { value = hn::IfThenElse(beyond, all(to), value); };
    choose(look.fresh.x, out.fresh.x), choose(look.fresh.y, out.fresh.y);
    choose(look.fresh.z, out.fresh.z), choose(look.drying.x, out.drying.x);
    choose(look.drying.y, out.drying.y), choose(look.drying.z, out.drying.z);
    choose(look.half, out.half), choose(look.flower, out.flower);
    choose(static_cast<float>(s), out.kind);
  }
  return out;
}

// 1 for blades on mown ground, else 0, and the shares that are below cut grass.
struct LanesCut {
  Lanes is_cut, hidden;
};

HWY_INLINE LanesCut cutLanes(const RibbonPlan& p, Lanes u, Lanes v) {
  const CrushPatch& crush = *p.style.crush;
  const IndexTag tag;
  // Lanes beyond the last blade may hold anything.
  const Indices last = hn::Set(tag, static_cast<std::int32_t>(crush.cut.size()) - 1);
  const Indices node = hn::Min(hn::Max(nearestAt(u, v, crush.cells), hn::Zero(tag)), last);
  const Lanes swath = hn::GatherIndex(Tag(), crush.swath.data(), node);
  const auto is_cut = hn::GatherIndex(Tag(), crush.cut.data(), node) < all(UNCUT);
  return {hn::IfThenElseZero(is_cut, all(1.f)), swath / (swath + all(HALF_HIDDEN))};
}

// Light on pieces of blades in their own colours: shadeRibbon() and lightOn().
struct LanesPiece {
  Lanes3 own, p, root;
  Lanes way, facing;
};

/// GrassLight in single precision.
struct FloatLight {
  explicit FloatLight(const GrassLight& light)
      : up(static_cast<float>(light.to_sun.z())),
        across(std::sqrt(std::max(0.f, 1.f - up * up))),
        shine(static_cast<float>(light.shine)),
        sun(toFloat3(light.sun)),
        sky(toFloat3(light.sky)) {}
  float up, across, shine;
  Float3 sun, sky;
};

HWY_INLINE Lanes litChannel(Lanes own, float sun, float sky, Lanes direct, Lanes open, Lanes depth,
                            Lanes shine) {
  const Lanes factor = (all(sun) * direct + all(sky) * open) * depth;
  return own * factor + shine * all(sun);
}

HWY_INLINE Lanes3 litLanes(const LanesPiece& piece, const FloatLight& light, const Float3& eye) {
  const Lanes zero = hn::Zero(Tag()), one = all(1.f), small = all(1e-6f);
  const Lanes3 lean = difference(piece.p, piece.root), view = difference(piece.p, all3(eye));
  const Lanes lying = hn::Sqrt(lean.x * lean.x + lean.y * lean.y);
  const Lanes long_way = hn::Sqrt(lying * lying + lean.z * lean.z);
  const Lanes far = hn::Sqrt(view.x * view.x + view.y * view.y);
  const Lanes part = hn::IfThenElseZero(long_way > small, lying / long_way);
  const Lanes away = hn::IfThenElseZero(hn::And(lying > small, far > small),
                                        (lean.x * view.x + lean.y * view.y) / (lying * far));
  const Lanes flat = part * part, upright = one - flat, way = piece.way;
  const Lanes direct =
      upright * all(light.across) * (all(0.5f) + all(0.5f) * piece.facing) + flat * all(light.up);
  const Lanes depth =
      upright * (all(0.36f) + all(0.64f) * way) + flat * (all(0.70f) + all(0.30f) * way);
  const Lanes shine =
      all(light.shine) * flat * depth * hn::Max(zero, all(0.55f) + all(0.45f) * away);
  const Lanes open = all(0.6f) + all(0.4f) * flat;
  return {litChannel(piece.own.x, light.sun.x, light.sky.x, direct, open, depth, shine),
          litChannel(piece.own.y, light.sun.y, light.sky.y, direct, open, depth, shine),
          litChannel(piece.own.z, light.sun.z, light.sky.z, direct, open, depth, shine)};
}

HWY_INLINE Words byteLanes(Lanes part) {
  const Lanes rounded = all(255.f) * unitOf(part) + all(0.5f);
  return hn::BitCast(WordTag(), hn::ConvertTo(IndexTag(), rounded));
}

// Red, green, blue, alpha in rising bytes.
HWY_INLINE Words pixelLanes(const Lanes3& c) {
  return hn::Or(hn::Or(byteLanes(c.x), hn::ShiftLeft<8>(byteLanes(c.y))),
                hn::Or(hn::ShiftLeft<16>(byteLanes(c.z)), hn::Set(WordTag(), 0xff000000U)));
}

}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Tests of one ray against the boxes of a node and the rods of a group, for each instruction set.
#if defined(VEGETATION_SIM_RAY_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_RAY_TESTS_INL_H
#undef VEGETATION_SIM_RAY_TESTS_INL_H
#else
#define VEGETATION_SIM_RAY_TESTS_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "sensors/traversal/wide_walk.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::scan::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::WIDTH>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes all(float value) {
  return hn::Set(Tag(), value);
}

template <class Mask>
HWY_INLINE unsigned bitsOf(Mask mask, int first) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  return static_cast<unsigned>(bytes[0]) << first;
}

// Returns the boxes that the ray enters before the limit. Relative errors of the products are below
// 2^-22; the rest is in the margin of the origins.
HWY_INLINE unsigned testBoxes(const PlacedRay& placed, const WideNode& node, float* entries) {
  const FloatRay& ray = *placed.ray;
  const auto reach = [&](const int* plane, const float* origin, int axis, int first) HWY_ATTR {
    return (hn::Load(Tag(), node.planes[plane[axis]] + first) - all(origin[axis])) *
           all(ray.inverse[axis]);
  };
  unsigned bits = 0;
  for (int first = 0; first < WideNode::WIDTH; first += static_cast<int>(hn::Lanes(Tag()))) {
    const Lanes near =
        hn::Max(hn::Max(reach(ray.near_plane, placed.near_origin, 0, first),
                        reach(ray.near_plane, placed.near_origin, 1, first)),
                hn::Max(reach(ray.near_plane, placed.near_origin, 2, first), hn::Zero(Tag())));
    const Lanes far = hn::Min(hn::Min(reach(ray.far_plane, placed.far_origin, 0, first),
                                      reach(ray.far_plane, placed.far_origin, 1, first)),
                              reach(ray.far_plane, placed.far_origin, 2, first));
    hn::Store(near, Tag(), entries + first);
    bits |= bitsOf(hn::And(near <= far * all(1.f + 0x1p-20f), near <= all(placed.limit)), first);
  }
  return bits;
}

HWY_INLINE void prefetch(const void* place) {
  static_assert(sizeof(WideNode) == 256 && sizeof(RodGroup) == 256, "four cache lines");
  for (int line = 0; line < 4; ++line)
    hwy::Prefetch(static_cast<const char*>(place) + std::ptrdiff_t{64} * line);
}

// Puts a child on the stack, above those that are farther; those below `begin` stay.
HWY_INLINE void insert(WaitingChild* waiting, int& count, int begin, const WaitingChild& child) {
  int place = count++;
  for (; place > begin && waiting[place - 1].entry < child.entry; --place)
    waiting[place] = waiting[place - 1];
  waiting[place] = child;
}

struct Components {
  Lanes x, y, z;
};

HWY_INLINE Lanes dot(const Components& a, const float* b) {
  return a.x * all(b[0]) + a.y * all(b[1]) + a.z * all(b[2]);
}

// Loads numbers that roundUp() has made.
HWY_INLINE Lanes loadHalves(const std::uint16_t* from) {
  const hn::RebindToUnsigned<Tag> words;
  const hn::Rebind<std::uint16_t, Tag> halves;
  return hn::BitCast(Tag(), hn::ShiftLeft<16>(hn::PromoteTo(words, hn::Load(halves, from))));
}

// Returns bounds of the radii of rods without their room.
HWY_INLINE Lanes loadBare(const RodGroup& group, int first, Lanes radius) {
  const hn::Rebind<std::uint8_t, Tag> bytes;
  const hn::RebindToSigned<Tag> words;
  const Lanes parts =
      hn::ConvertTo(Tag(), hn::PromoteTo(words, hn::Load(bytes, group.bare + first)));
  return parts * radius * all(1.f / BARE_PARTS);
}

// Tests the axes, seen along the ray, against the radius: the nearest point of each to the ray is
// nearer than that, and the rod is neither behind the origin nor beyond the limit.
HWY_INLINE void testRods(const PlacedRay& placed, const RodGroup& group, RodCandidates& out) {
  const FloatRay& ray = *placed.ray;
  const auto rows = [&](const float(*from)[WideNode::WIDTH], int first) HWY_ATTR {
    return Components{hn::Load(Tag(), from[0] + first), hn::Load(Tag(), from[1] + first),
                      hn::Load(Tag(), from[2] + first)};
  };
  const Lanes zero = hn::Zero(Tag()), one = all(1.f);
  out.lanes = out.bare = 0;
  for (int first = 0; first < group.count; first += static_cast<int>(hn::Lanes(Tag()))) {
    const Components way = rows(group.way, first);
    Components base = rows(group.base, first);
    base = {base.x - all(placed.origin[0]), base.y - all(placed.origin[1]),
            base.z - all(placed.origin[2])};
    const Lanes u = dot(base, ray.across[0]), v = dot(base, ray.across[1]);
    const Lanes way_u = dot(way, ray.across[0]), way_v = dot(way, ray.across[1]);
    const Lanes square = hn::Max(way_u * way_u + way_v * way_v, all(1e-30f));
    const Lanes part = hn::Min(hn::Max((zero - (u * way_u + v * way_v)) / square, zero), one);
    const Lanes at_u = u + part * way_u, at_v = v + part * way_v;
    const Lanes room = loadHalves(group.radius + first);
    const Lanes radius = room + all(placed.margin);
    const Lanes bare = loadBare(group, first, room) + all(placed.margin);
    const Lanes along = dot(base, ray.direction), more = dot(way, ray.direction);
    const Lanes distance = at_u * at_u + at_v * at_v;
    const auto close = distance <= radius * radius;
    const Lanes entry = along + hn::Min(more, zero) - radius;
    hn::Store(entry, Tag(), out.entries + first);
    const auto begins = entry <= all(placed.limit);
    const auto ends = along + hn::Max(more, zero) + radius >= zero;
    out.lanes |= bitsOf(hn::And(close, hn::And(begins, ends)), first);
    out.bare |= bitsOf(distance <= bare * bare, first);
  }
  out.lanes &= (1U << group.count) - 1U;
}

}  // namespace vegetation_sim::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

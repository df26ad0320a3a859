// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/wide_walk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensors/geometry/wide_walk.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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
HWY_INLINE unsigned testBoxes(const WideWalk& walk, const WideNode& node, float* entries) {
  const FloatRay& ray = *walk.ray;
  const auto reach = [&](const int* plane, const float* origin, int axis, int first) HWY_ATTR {
    return (hn::Load(Tag(), node.planes[plane[axis]] + first) - all(origin[axis])) *
           all(ray.inverse[axis]);
  };
  unsigned bits = 0;
  for (int first = 0; first < WideNode::WIDTH; first += static_cast<int>(hn::Lanes(Tag()))) {
    const Lanes near =
        hn::Max(hn::Max(reach(ray.near_plane, walk.near_origin, 0, first),
                        reach(ray.near_plane, walk.near_origin, 1, first)),
                hn::Max(reach(ray.near_plane, walk.near_origin, 2, first), hn::Zero(Tag())));
    const Lanes far = hn::Min(hn::Min(reach(ray.far_plane, walk.far_origin, 0, first),
                                      reach(ray.far_plane, walk.far_origin, 1, first)),
                              reach(ray.far_plane, walk.far_origin, 2, first));
    hn::Store(near, Tag(), entries + first);
    bits |= bitsOf(hn::And(near <= far * all(1.f + 0x1p-20f), near <= all(walk.limit)), first);
  }
  return bits;
}

HWY_INLINE void prefetch(const void* place) {
  static_assert(sizeof(WideNode) == 256 && sizeof(RodGroup) == 256, "four cache lines");
  for (int line = 0; line < 4; ++line)
    hwy::Prefetch(static_cast<const char*>(place) + std::ptrdiff_t{64} * line);
}

HWY_INLINE void prefetch(const WideWalk& walk, std::int32_t child) {
  if (child >= 0)
    prefetch(walk.nodes + child);
  else if (walk.groups)
    prefetch(walk.groups + ~child);
}

// Puts the children on the stack, the nearest on top. Their memory is on its way while others are
// tested.
HWY_INLINE void push(WideWalk& walk, const WideNode& node, unsigned bits, const float* entries) {
  const int begin = walk.count;
  for (; bits != 0; bits &= bits - 1) {
    const auto slot = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
    const float entry = entries[slot];
    const std::int32_t child = node.child[slot];
    prefetch(walk, child);
    int place = walk.count++;
    for (; place > begin && walk.waiting[place - 1].entry < entry; --place)
      walk.waiting[place] = walk.waiting[place - 1];
    walk.waiting[place] = {entry, child};
  }
}

// Returns the child that the ray enters first, or EMPTY, and puts the others on the stack.
HWY_INLINE std::int32_t descend(WideWalk& walk, const WideNode& node) {
  alignas(64) float entries[WideNode::WIDTH];
  const unsigned bits = testBoxes(walk, node, entries);
  if (bits == 0) return WideNode::EMPTY;
  const auto first = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
  const unsigned others = bits & (bits - 1);
  if (others == 0) return node.child[first];
  if ((others & (others - 1)) == 0) {
    const auto second = hwy::Num0BitsBelowLS1Bit_Nonzero32(others);
    const bool swap = entries[second] < entries[first];
    const auto near = swap ? second : first, far = swap ? first : second;
    prefetch(walk, node.child[far]);
    walk.waiting[walk.count++] = {entries[far], node.child[far]};
    return node.child[near];
  }
  push(walk, node, bits, entries);
  return walk.waiting[--walk.count].child;
}

HWY_INLINE int advance(WideWalk& walk) {
  while (walk.count > 0) {
    const WideWalk::Waiting next = walk.waiting[--walk.count];
    if (!(next.entry <= walk.limit)) continue;
    std::int32_t child = next.child;
    while (child >= 0) child = descend(walk, walk.nodes[child]);
    if (child != WideNode::EMPTY) return ~child;
  }
  return -1;
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

// Tests the axes, seen along the ray, against the radius: the nearest point of each to the ray is
// nearer than that, and the rod is neither behind the origin nor beyond the limit.
HWY_INLINE unsigned testRods(const WideWalk& walk, const RodGroup& group, float* entries) {
  const FloatRay& ray = *walk.ray;
  const auto rows = [&](const float(*from)[WideNode::WIDTH], int first) HWY_ATTR {
    return Components{hn::Load(Tag(), from[0] + first), hn::Load(Tag(), from[1] + first),
                      hn::Load(Tag(), from[2] + first)};
  };
  const Lanes zero = hn::Zero(Tag()), one = all(1.f);
  unsigned bits = 0;
  for (int first = 0; first < group.count; first += static_cast<int>(hn::Lanes(Tag()))) {
    const Components way = rows(group.way, first);
    Components base = rows(group.base, first);
    base = {base.x - all(walk.origin[0]), base.y - all(walk.origin[1]),
            base.z - all(walk.origin[2])};
    const Lanes u = dot(base, ray.across[0]), v = dot(base, ray.across[1]);
    const Lanes way_u = dot(way, ray.across[0]), way_v = dot(way, ray.across[1]);
    const Lanes square = hn::Max(way_u * way_u + way_v * way_v, all(1e-30f));
    const Lanes part = hn::Min(hn::Max((zero - (u * way_u + v * way_v)) / square, zero), one);
    const Lanes at_u = u + part * way_u, at_v = v + part * way_v;
    const Lanes radius = loadHalves(group.radius + first) + all(walk.margin);
    const Lanes along = dot(base, ray.direction), more = dot(way, ray.direction);
    const auto close = at_u * at_u + at_v * at_v <= radius * radius;
    const Lanes entry = along + hn::Min(more, zero) - radius;
    hn::Store(entry, Tag(), entries + first);
    const auto begins = entry <= all(walk.limit);
    const auto ends = along + hn::Max(more, zero) + radius >= zero;
    bits |= bitsOf(hn::And(close, hn::And(begins, ends)), first);
  }
  return bits & ((1U << group.count) - 1U);
}

int nextBox(WideWalk& walk) {
  return advance(walk);
}

RodCandidates nextFew(WideWalk& walk) {
  RodCandidates out;
  for (int group = advance(walk); group >= 0; group = advance(walk)) {
    out.group = group;
    out.lanes = testRods(walk, walk.groups[group], out.entries);
    if (out.lanes != 0) break;
  }
  return out;
}

}  // namespace vegetation_sim::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::scan {
namespace {

HWY_EXPORT(nextBox);
HWY_EXPORT(nextFew);

constexpr double SMALLEST = 1e-18;  // of a component; over 10^6 m the ray deviates by 1e-12 m

// Returns two unit vectors perpendicular to a unit vector (Duff et al. 2017).
void setAcross(const Vec3& d, float (&out)[2][3]) {
  const double sign = std::copysign(1.0, d.z()), a = -1.0 / (sign + d.z()), b = d.x() * d.y() * a;
  const Vec3 u(1.0 + sign * d.x() * d.x() * a, sign * b, -sign * d.x());
  const Vec3 v(b, sign + d.y() * d.y() * a, -d.y());
  for (int i = 0; i < 3; ++i) {
    out[0][i] = static_cast<float>(u[i]);
    out[1][i] = static_cast<float>(v[i]);
  }
}

}  // namespace

FloatRay::FloatRay(const Ray& ray) : valid(ray.origin.allFinite() && ray.direction.allFinite()) {
  const double square = dot(ray.direction, ray.direction);
  // The square of the perpendicular distance deviates by |square - 1| times that of the distance.
  slack = 0x1p-19 + std::sqrt(std::fabs(square - 1.0)) + std::fabs(square - 1.0);
  for (int i = 0; i < 3; ++i) {
    const bool back = ray.direction[i] < 0.0;
    const double size = std::max(std::fabs(ray.direction[i]), SMALLEST);
    direction[i] = static_cast<float>(ray.direction[i]);
    inverse[i] = static_cast<float>((back ? -1.0 : 1.0) / size);
    near_plane[i] = back ? 3 + i : i;
    far_plane[i] = back ? i : 3 + i;
  }
  setAcross(ray.direction / std::sqrt(square), across);
}

std::uint16_t roundUp(float positive) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &positive, sizeof bits);
  return static_cast<std::uint16_t>((bits + 0xFFFFU) >> 16);
}

float limitOf(double distance) {
  return static_cast<float>(distance * (1.0 + 0x1p-20) + 1e-6);
}

WalkedTree::WalkedTree(const WideTree& tree, const RodGroup* rods)
    : nodes(tree.nodes().empty() ? nullptr : tree.nodes().data()),
      groups(rods),
      origin(tree.origin()),
      extent(tree.extent()) {}

WalkedTree::WalkedTree(const std::vector<WideNode>& all, const std::vector<RodGroup>& rods,
                       const Vec3& place, double size)
    : nodes(all.empty() ? nullptr : all.data()), groups(rods.data()), origin(place), extent(size) {}

WideWalk::WideWalk(const WalkedTree& tree, const Ray& wide, const FloatRay& narrow, double distance)
    : nodes(tree.nodes), groups(tree.groups), ray(&narrow), limit(limitOf(distance)) {
  const Vec3 from = wide.origin - tree.origin;
  margin = static_cast<float>(narrow.slack * (from.cwiseAbs().sum() + tree.extent));
  for (int i = 0; i < 3; ++i) {
    origin[i] = static_cast<float>(from[i]);
    const float towards = narrow.inverse[i] < 0.f ? -margin : margin;
    near_origin[i] = origin[i] + towards;
    far_origin[i] = origin[i] - towards;
  }
  if (narrow.valid && nodes) waiting[count++] = {0.f, 0};
}

int nextGroup(WideWalk& walk) {
  return HWY_DYNAMIC_DISPATCH(nextBox)(walk);
}

RodCandidates nextRods(WideWalk& walk) {
  return HWY_DYNAMIC_DISPATCH(nextFew)(walk);
}

}  // namespace vegetation_sim::scan
#endif

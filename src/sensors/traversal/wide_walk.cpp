// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/wide_walk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensors/traversal/wide_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sensors/traversal/ray_tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::scan::HWY_NAMESPACE {

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
    prefetch(walk, node.child[slot]);
    insert(walk.waiting, walk.count, begin, {entries[slot], node.child[slot]});
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
    const WaitingChild next = walk.waiting[--walk.count];
    if (!(next.entry <= walk.limit)) continue;
    std::int32_t child = next.child;
    while (child >= 0) child = descend(walk, walk.nodes[child]);
    if (child != WideNode::EMPTY) return ~child;
  }
  return -1;
}

int nextBox(WideWalk& walk) {
  return advance(walk);
}

RodCandidates nextFew(WideWalk& walk) {
  RodCandidates out;
  for (int group = advance(walk); group >= 0; group = advance(walk)) {
    out.group = group;
    testRods(walk, walk.groups[group], out);
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

constexpr double LARGEST = 1e18;  // inverse; over 10^6 m the ray deviates by 1e-12 m

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
    direction[i] = static_cast<float>(ray.direction[i]);
    const double size = std::min(std::fabs(ray.inverse[i]), LARGEST);
    inverse[i] = static_cast<float>(back ? -size : size);
    near_plane[i] = back ? 3 + i : i;
    far_plane[i] = back ? i : 3 + i;
  }
  setAcross(1.0 / std::sqrt(square) * ray.direction, across);
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

PlacedRay::PlacedRay(const WalkedTree& tree, const Ray& wide, const FloatRay& narrow,
                     double distance)
    : ray(&narrow), limit(limitOf(distance)) {
  const Vec3 from = wide.origin - tree.origin;
  margin = static_cast<float>(narrow.slack * (from.cwiseAbs().sum() + tree.extent));
  for (int i = 0; i < 3; ++i) {
    origin[i] = static_cast<float>(from[i]);
    const float towards = narrow.inverse[i] < 0.f ? -margin : margin;
    near_origin[i] = origin[i] + towards;
    far_origin[i] = origin[i] - towards;
  }
}

WideWalk::WideWalk(const WalkedTree& tree, const Ray& wide, const FloatRay& narrow, double distance)
    : PlacedRay(tree, wide, narrow, distance), nodes(tree.nodes), groups(tree.groups) {
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

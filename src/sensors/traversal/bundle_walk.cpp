// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/bundle_walk.h"

#include <algorithm>
#include <cstddef>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensors/traversal/bundle_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sensors/traversal/ray_tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::scan::HWY_NAMESPACE {

// Returns the boxes that a ray of the bundle may enter before the limit. Differences and products
// are rounded monotonically: no ray enters a box earlier, or leaves it later, than the bounds.
HWY_INLINE unsigned testBundle(const BundleWalk& walk, const WideNode& node, float* entries) {
  const auto depth = [&](const int* plane, const float* origin, int axis, int first) HWY_ATTR {
    return hn::Load(Tag(), node.planes[plane[axis]] + first) - all(origin[axis]);
  };
  const auto enter = [&](int axis, int first) HWY_ATTR {
    const Lanes way = depth(walk.near_plane, walk.near_origin, axis, first);
    return hn::Min(way * all(walk.least_inverse[axis]), way * all(walk.most_inverse[axis]));
  };
  const auto leave = [&](int axis, int first) HWY_ATTR {
    const Lanes way = depth(walk.far_plane, walk.far_origin, axis, first);
    return hn::Max(way * all(walk.least_inverse[axis]), way * all(walk.most_inverse[axis]));
  };
  unsigned bits = 0;
  for (int first = 0; first < WideNode::WIDTH; first += static_cast<int>(hn::Lanes(Tag()))) {
    const Lanes near = hn::Max(hn::Max(enter(0, first), enter(1, first)),
                               hn::Max(enter(2, first), hn::Zero(Tag())));
    const Lanes far = hn::Min(hn::Min(leave(0, first), leave(1, first)), leave(2, first));
    hn::Store(near, Tag(), entries + first);
    bits |= bitsOf(hn::And(near <= far * all(1.f + 0x1p-20f), near <= all(walk.limit)), first);
  }
  return bits;
}

// Adds a group with the box that its node has for it.
HWY_INLINE void addFound(BundleWalk& walk, const WideNode& node, std::size_t slot) {
  WideNode& to = walk.boxes[walk.found / WideNode::WIDTH];
  const int at = walk.found++ % WideNode::WIDTH;
  for (int i = 0; i < 6; ++i) to.planes[i][at] = node.planes[i][slot];
  to.child[at] = ~node.child[slot];
  prefetch(walk.groups + to.child[at]);
}

bool findMany(BundleWalk& walk) {
  walk.found = 0;
  while (walk.count > 0 && walk.found <= BundleWalk::MOST_FOUND - WideNode::WIDTH) {
    const WaitingChild next = walk.waiting[--walk.count];
    if (!(next.entry <= walk.limit)) continue;
    const WideNode& node = walk.nodes[next.child];
    alignas(64) float entries[WideNode::WIDTH];
    const int begin = walk.count;
    for (unsigned bits = testBundle(walk, node, entries); bits != 0; bits &= bits - 1) {
      const auto slot = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      const std::int32_t child = node.child[slot];
      if (child >= 0) {
        prefetch(walk.nodes + child);
        insert(walk.waiting, walk.count, begin, {entries[slot], child});
      } else if (child != WideNode::EMPTY) {
        addFound(walk, node, slot);
      }
    }
  }
  return walk.found > 0;
}

void testMany(const BundleWalk& walk, int ray, FoundGroups& out) {
  out.left = 0;
  for (int first = 0; first < walk.found; first += WideNode::WIDTH)
    out.left |=
        testBoxes(walk.placed[ray], walk.boxes[first / WideNode::WIDTH], out.entries + first)
        << first;
  out.left &= (1U << walk.found) - 1U;
}

HWY_INLINE int takeNearest(FoundGroups& groups) {
  unsigned bits = groups.left;
  auto nearest = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
  for (bits &= bits - 1; bits != 0; bits &= bits - 1) {
    const auto other = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
    if (groups.entries[other] < groups.entries[nearest]) nearest = other;
  }
  groups.left &= ~(1U << nearest);
  return static_cast<int>(nearest);
}

RodCandidates nextFew(const BundleWalk& walk, int ray, FoundGroups& groups) {
  RodCandidates out;
  const PlacedRay& placed = walk.placed[ray];
  while (groups.left != 0) {
    const int nearest = takeNearest(groups);
    if (!(groups.entries[nearest] <= placed.limit)) break;
    out.group = walk.boxes[nearest / WideNode::WIDTH].child[nearest % WideNode::WIDTH];
    testRods(placed, walk.groups[out.group], out);
    if (out.lanes != 0) break;
  }
  return out;
}

}  // namespace vegetation_sim::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::scan {
namespace {

HWY_EXPORT(findMany);
HWY_EXPORT(testMany);
HWY_EXPORT(nextFew);

constexpr double LEAST_COSINE = 0.985;  // of the first ray with another: 10 degrees

bool haveEqualSigns(const FloatRay& a, const FloatRay& b) {
  return std::equal(a.near_plane, a.near_plane + 3, b.near_plane);
}

}  // namespace

int countBundled(const Ray* rays, const FloatRay* narrow, int count) {
  if (!narrow[0].valid) return 1;
  int out = 1;
  for (; out < std::min(count, RayBundle::MOST_RAYS); ++out)
    if (!narrow[out].valid || !haveEqualSigns(narrow[0], narrow[out]) ||
        !(dot(rays[0].direction, rays[out].direction) >= LEAST_COSINE))
      break;
  return out;
}

BundleWalk::BundleWalk(const WalkedTree& tree, const RayBundle& bundle, const Hit* nearest)
    : nodes(tree.nodes), groups(tree.groups), rays(bundle.count) {
  for (int r = 0; r < rays; ++r)
    placed[r] = PlacedRay(tree, bundle.rays[r], bundle.narrow[r], nearest[r].distance);
  for (int i = 0; i < 3; ++i) {
    near_plane[i] = bundle.narrow[0].near_plane[i];
    far_plane[i] = bundle.narrow[0].far_plane[i];
    near_origin[i] = placed[0].near_origin[i];
    far_origin[i] = placed[0].far_origin[i];
    least_inverse[i] = most_inverse[i] = bundle.narrow[0].inverse[i];
  }
  for (int r = 1; r < rays; ++r)
    for (int i = 0; i < 3; ++i) {
      const float inverse = bundle.narrow[r].inverse[i];
      const float near = placed[r].near_origin[i], far = placed[r].far_origin[i];
      near_origin[i] =
          inverse < 0.f ? std::min(near_origin[i], near) : std::max(near_origin[i], near);
      far_origin[i] = inverse < 0.f ? std::max(far_origin[i], far) : std::min(far_origin[i], far);
      least_inverse[i] = std::min(least_inverse[i], inverse);
      most_inverse[i] = std::max(most_inverse[i], inverse);
    }
  updateLimit();
  if (bundle.narrow[0].valid && nodes) waiting[count++] = {0.f, 0};
}

void BundleWalk::updateLimit() {
  limit = placed[0].limit;
  for (int r = 1; r < rays; ++r) limit = std::max(limit, placed[r].limit);
}

bool findGroups(BundleWalk& walk) {
  return HWY_DYNAMIC_DISPATCH(findMany)(walk);
}

void testFound(const BundleWalk& walk, int ray, FoundGroups& out) {
  HWY_DYNAMIC_DISPATCH(testMany)(walk, ray, out);
}

RodCandidates nextRods(const BundleWalk& walk, int ray, FoundGroups& groups) {
  return HWY_DYNAMIC_DISPATCH(nextFew)(walk, ray, groups);
}

}  // namespace vegetation_sim::scan
#endif

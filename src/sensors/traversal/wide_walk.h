// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/ray.h"
#include "sensors/traversal/wide_tree.h"

namespace vegetation_sim::scan {

// Rays are led through the boxes in single precision. The tests are conservative: they may let a
// ray into a box that it misses, but never keep it from an item that the test in double precision
// hits. The hits therefore do not depend on the boxes or on the instruction set.

/// A ray in single precision.
struct FloatRay {
  explicit FloatRay(const Ray& ray);

  float direction[3], inverse[3];   ///< inverse: finite also for a component of 0
  float across[2][3];               ///< unit vectors perpendicular to the ray and to each other
  int near_plane[3], far_plane[3];  ///< rows of WideNode::planes
  /// Bound of all errors over the distance from the ray's origin: rounding, and the deviation of
  /// the direction's length from 1.
  double slack;
  bool valid;  ///< all components are finite
};

/// Returns a bound for comparison with distances in single precision.
float limitOf(double distance);

/// Eight rods without their taper, relative to the origin of their tree [m].
struct alignas(64) RodGroup {
  float base[3][WideNode::WIDTH], way[3][WideNode::WIDTH];  ///< way: from base to tip
  std::uint16_t radius[WideNode::WIDTH];                    ///< as roundUp() makes them
  std::int32_t count{0};
  std::uint32_t tree{0};                  ///< its index in a set of trees
  std::uint32_t rods[WideNode::WIDTH]{};  ///< indices in the tree
  /// Bounds of the radii of the rods without the room around them, in parts of `radius`.
  std::uint8_t bare[WideNode::WIDTH]{};
};

/// Parts of a radius that RodGroup::bare counts.
constexpr int BARE_PARTS = 254;

/// Returns the upper half of the bits of the next number that needs no more.
std::uint16_t roundUp(float positive);

/// Nodes of a tree whose first one is its root, and the groups that they lead to.
struct WalkedTree {
  explicit WalkedTree(const WideTree& tree, const RodGroup* rods = nullptr);
  WalkedTree(const std::vector<WideNode>& all, const std::vector<RodGroup>& rods, const Vec3& place,
             double size);

  const WideNode* nodes;   ///< null: the tree is empty
  const RodGroup* groups;  ///< null: the tree is of boxes alone
  Vec3 origin;
  double extent;  ///< as that of a WideTree
};

/// A ray relative to the origin of a tree.
struct PlacedRay {
  PlacedRay() = default;  // not initialised
  PlacedRay(const WalkedTree& tree, const Ray& ray, const FloatRay& narrow, double distance);

  const FloatRay* ray;
  float origin[3];                      ///< relative to that of the tree [m]
  float near_origin[3], far_origin[3];  ///< moved so that boxes grow by the margin
  float margin;                         ///< bound of the error of places [m]
  float limit;                          ///< limitOf() the nearest hit so far
};

/// A child of a node that waits for its visit.
struct WaitingChild {
  float entry;
  std::int32_t child;
};

/// Traversal of a tree by a ray; the nearest box is visited first.
struct WideWalk : PlacedRay {
  WideWalk(const WalkedTree& tree, const Ray& ray, const FloatRay& narrow, double distance);

  const WideNode* nodes;
  const RodGroup* groups;  ///< null: the tree is of boxes alone
  int count{0};
  WaitingChild waiting[WideTree::MOST_WAITING];  // not initialised
};

/// Returns the next group whose box the ray may hit, or -1.
int nextGroup(WideWalk& walk);

/// Rods of a group that a ray may hit.
struct RodCandidates {
  int group{-1};
  unsigned lanes{0};                           ///< bit i: item i of the group; 0 at the end
  unsigned bare{0};                            ///< those whose rod it may hit, not only the room
  alignas(64) float entries[WideNode::WIDTH];  ///< bounds of the distances of their entries
};
/// Returns the candidates of the next group that has any.
RodCandidates nextRods(WideWalk& walk);

/// Calls meet(item of the group), which may reduce `nearest`, for the candidates; near ones first,
/// and not for those beyond the nearest hit.
template <class Meet>
void meetNearestFirst(PlacedRay& ray, const RodCandidates& found, const Hit& nearest, Meet&& meet) {
  for (unsigned lanes = found.lanes; lanes != 0;) {
    int next = -1;
    for (int i = 0; lanes >> i != 0; ++i)
      if ((lanes >> i & 1U) != 0 && (next < 0 || found.entries[i] < found.entries[next])) next = i;
    if (!(found.entries[next] <= ray.limit)) return;
    meet(next);
    ray.limit = limitOf(nearest.distance);
    lanes &= ~(1U << next);
  }
}

}  // namespace vegetation_sim::scan

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/traversal/wide_walk.h"

namespace vegetation_sim::scan {

/// Rays with similar directions, and with similar origins, or else too many groups are found for
/// them. They traverse a tree together: a node is
/// tested once for all of them, with bounds of their origins and of their directions, and each ray
/// is tested alone against the groups of rods that are found. Each ray has the candidates that it
/// has alone, in an order that may differ.
struct RayBundle {
  static constexpr int MOST_RAYS = 32;

  const Ray* rays;
  const FloatRay* narrow;
  int count;
};

/// Returns how many of the first of `count` rays form a bundle, at least one: components of
/// directions have equal signs in it, and directions differ by at most 10 degrees.
int countBundled(const Ray* rays, const FloatRay* narrow, int count);

/// Traversal of a tree of rods by a bundle.
struct BundleWalk {
  /// @param nearest hit of each ray so far.
  BundleWalk(const WalkedTree& tree, const RayBundle& bundle, const Hit* nearest);
  /// Sets the limit of the bundle to the largest one of its rays.
  void updateLimit();

  static constexpr int MOST_FOUND = 2 * WideNode::WIDTH;

  const WideNode* nodes;
  const RodGroup* groups;
  int rays;
  PlacedRay placed[RayBundle::MOST_RAYS];
  // Bounds over all rays.
  int near_plane[3], far_plane[3];
  float near_origin[3], far_origin[3];  ///< those with which a box is the largest
  float least_inverse[3], most_inverse[3];
  float limit;
  // Groups that are found, with their boxes.
  int found{0};
  WideNode boxes[MOST_FOUND / WideNode::WIDTH];

  int count{0};
  WaitingChild waiting[WideTree::MOST_WAITING];  // not initialised
};

/// Finds the next groups that the bundle may hit. Returns false if there are none.
bool findGroups(BundleWalk& walk);

/// Found groups that are still to be tested for one ray.
struct FoundGroups {
  unsigned left{0};  ///< bit i: group i
  alignas(64) float entries[BundleWalk::MOST_FOUND];
};
/// Returns the found groups whose boxes a ray may hit.
void testFound(const BundleWalk& walk, int ray, FoundGroups& out);
/// Returns the candidates of the nearest group that is left and has any, and takes it out.
RodCandidates nextRods(const BundleWalk& walk, int ray, FoundGroups& groups);

}  // namespace vegetation_sim::scan

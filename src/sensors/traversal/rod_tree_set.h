// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/traversal/bundle_walk.h"
#include "sensors/traversal/rod_tree.h"

namespace vegetation_sim::scan {

/// The rods of several plants in one wide tree, so that a ray is led through all of them at once,
/// nearest boxes first. Its first nodes hold the plants' boxes; the nodes of each plant follow.
class RodTreeSet {
 public:
  /// Copies the nodes and rods of all trees, which must be fitted to `origin`.
  void set(const std::vector<const RodTree*>& trees, const Vec3& origin, ThreadPool& threads);

  /// Calls meet(tree, rod, bare), which may reduce `nearest`, for each rod that a ray may hit; near
  /// ones first. If not `bare`, the ray misses the rod and meets only the room around it.
  template <class Meet>
  void visit(const Ray& ray, const FloatRay& narrow, const Hit& nearest, Meet&& meet) const {
    WideWalk walk(WalkedTree(nodes_, groups_, boxes_.origin(), boxes_.extent()), ray, narrow,
                  nearest.distance);
    for (RodCandidates next = nextRods(walk); next.lanes != 0; next = nextRods(walk)) {
      const RodGroup& group = groups_[static_cast<std::size_t>(next.group)];
      meetNearestFirst(walk, next, nearest, [&](int i) {
        meet(std::size_t{group.tree}, std::size_t{group.rods[i]}, (next.bare >> i & 1U) != 0);
      });
    }
  }

  /// Calls meet(ray, tree, rod, bare), which may reduce the hit of that ray, for each rod that it
  /// may hit, after fetch(tree, rod) for some of them.
  /// @param nearest the hit of each ray of the bundle.
  template <class Fetch, class Meet>
  void visit(const RayBundle& bundle, const Hit* nearest, Fetch&& fetch, Meet&& meet) const {
    BundleWalk walk(WalkedTree(nodes_, groups_, boxes_.origin(), boxes_.extent()), bundle, nearest);
    FoundGroups found;
    for (; findGroups(walk); walk.updateLimit())
      for (int ray = 0; ray < bundle.count; ++ray) {
        testFound(walk, ray, found);
        while (found.left != 0) {
          const RodCandidates next = nextRods(walk, ray, found);
          if (next.lanes == 0) break;
          const RodGroup& group = groups_[static_cast<std::size_t>(next.group)];
          for (int i = 0; next.lanes >> i != 0; ++i)
            if ((next.lanes >> i & 1U) != 0) fetch(std::size_t{group.tree}, group.rods[i]);
          meetNearestFirst(walk.placed[ray], next, nearest[ray], [&](int i) {
            meet(ray, std::size_t{group.tree}, std::size_t{group.rods[i]},
                 (next.bare >> i & 1U) != 0);
          });
        }
      }
  }

 private:
  /// Where the nodes and groups of a tree begin.
  struct Place {
    std::int32_t node{0}, group{0};
  };
  void buildTop(const std::vector<const RodTree*>& trees, const Vec3& origin);
  void copyTree(const RodTree& tree, std::uint32_t index, const Place& place);

  WideTree boxes_{1};             ///< of the trees
  std::vector<WideNode> nodes_;   ///< of boxes_, then of each tree
  std::vector<RodGroup> groups_;  ///< of each tree
};

}  // namespace vegetation_sim::scan

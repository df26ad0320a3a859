// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sensors/geometry/rod.h"
#include "sensors/traversal/wide_walk.h"

namespace vegetation_sim::scan {

/// A rod and the room around its axis, such as that of its leaves, for the rod itself if smaller
/// than its own radius [m].
struct RoomyRod {
  const Rod& rod;
  double room;
};

/// Rods in a wide tree, whose order is chosen once; the rods may move.
class RodTree {
 public:
  /// Chooses the order of the rods. @param rod_at returns a RoomyRod for an index.
  template <class RodAt>
  void build(std::size_t count, const RodAt& rod_at, const Vec3& origin) {
    std::vector<Box> items;
    items.reserve(count);
    for (std::size_t i = 0; i < count; ++i) items.push_back(boxAround(rod_at(i)));
    build(items);
    fit(rod_at, origin);
  }
  /// Moves the rods. Requires as many as built.
  /// @param origin place near the rods; those that are nearer have smaller errors of rounding.
  template <class RodAt>
  void fit(const RodAt& rod_at, const Vec3& origin) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      boxes_[g] = Box();
      for (int i = 0; i < groups_[g].count; ++i)
        put(rod_at(std::size_t{groups_[g].rods[i]}), origin, i, g);
    }
    tree_.fit(boxes_, origin);
  }
  /// Do the same for rods with the room `radii`.
  void build(const std::vector<Rod>& rods, const std::vector<double>& radii, const Vec3& origin) {
    build(
        rods.size(),
        [&](std::size_t i) {
          return RoomyRod{rods[i], radii[i]};
        },
        origin);
  }
  void fit(const std::vector<Rod>& rods, const std::vector<double>& radii, const Vec3& origin) {
    fit([&](std::size_t i) { return RoomyRod{rods[i], radii[i]}; }, origin);
  }
  const WideTree& boxes() const { return tree_; }
  const std::vector<RodGroup>& groups() const { return groups_; }
  /// Returns the box of all rods with their radii.
  const Box& bounds() const { return tree_.bounds(); }

  /// Calls meet(rod), which may reduce `nearest`, for each rod that a ray may hit; near ones first.
  template <class Meet>
  void visit(const Ray& ray, const FloatRay& narrow, const Hit& nearest, Meet&& meet) const {
    WideWalk walk(WalkedTree(tree_, groups_.data()), ray, narrow, nearest.distance);
    for (RodCandidates next = nextRods(walk); next.lanes != 0; next = nextRods(walk)) {
      const RodGroup& group = groups_[static_cast<std::size_t>(next.group)];
      meetNearestFirst(walk, next, nearest, [&](int i) { meet(std::size_t{group.rods[i]}); });
    }
  }

 private:
  static Box boxAround(const RoomyRod& item);
  void build(const std::vector<Box>& items);
  /// Puts a rod into a group, and adds its box to that of the group.
  void put(const RoomyRod& item, const Vec3& origin, int lane, std::size_t group);

  WideTree tree_{WideNode::WIDTH};
  std::vector<RodGroup> groups_;
  std::vector<Box> boxes_;  ///< scratch of fit()
};

}  // namespace vegetation_sim::scan

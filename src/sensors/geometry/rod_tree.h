// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sensors/geometry/rod.h"
#include "sensors/geometry/wide_walk.h"

namespace vegetation_sim::scan {

/// Rods in a wide tree, whose order is chosen once; the rods may move.
class RodTree {
 public:
  /// Chooses the order of the rods. @param radii room around each rod's axis, such as that of its
  /// leaves, for the rod itself if smaller than its own radius [m].
  void build(const std::vector<Rod>& rods, const std::vector<double>& radii, const Vec3& origin);
  /// Moves the rods. Requires as many as built.
  /// @param origin place near the rods; those that are nearer have smaller errors of rounding.
  void fit(const std::vector<Rod>& rods, const std::vector<double>& radii, const Vec3& origin);
  const WideTree& boxes() const { return tree_; }
  const std::vector<RodGroup>& groups() const { return groups_; }
  /// Returns the box of all rods with their radii.
  const Box& bounds() const { return tree_.bounds(); }

  /// Calls meet(rod), which may reduce `nearest`, for each rod that a ray may hit; near ones first.
  template <class Meet>
  void visit(const Ray& ray, const FloatRay& narrow, const Hit& nearest, Meet&& meet) const {
    WideWalk walk(WalkedTree(tree_, groups_.data()), ray, narrow, nearest.distance);
    for (RodCandidates next = nextRods(walk); next.lanes != 0; next = nextRods(walk)) {
      for (int i = 0; next.lanes >> i != 0; ++i)
        if ((next.lanes >> i & 1U) != 0) meet(static_cast<std::size_t>(tree_.item(next.group, i)));
      walk.limit = limitOf(nearest.distance);
    }
  }

 private:
  WideTree tree_{WideNode::WIDTH};
  std::vector<RodGroup> groups_;
  std::vector<Box> boxes_;  ///< scratch of fit()
};

}  // namespace vegetation_sim::scan

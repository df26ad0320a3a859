// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sensors/geometry/strip.h"
#include "sensors/traversal/wide_walk.h"

namespace vegetation_sim::scan {

/// Strips in a wide tree, whose order is chosen once; the strips may move.
class StripTree {
 public:
  /// Chooses the order of the strips.
  void build(const std::vector<Strip>& strips, const Vec3& origin);
  /// Moves the strips. Requires as many as built.
  /// @param origin place near the strips; those that are nearer have smaller errors of rounding.
  void fit(const std::vector<Strip>& strips, const Vec3& origin);
  /// Returns the box of all strips.
  const Box& bounds() const { return tree_.bounds(); }

  /// Calls meet(strip), which may reduce `nearest`, for each strip that a ray may hit; near ones
  /// first.
  template <class Meet>
  void visit(const Ray& ray, const FloatRay& narrow, const Hit& nearest, Meet&& meet) const {
    WideWalk walk(WalkedTree(tree_), ray, narrow, nearest.distance);
    for (int group = nextGroup(walk); group >= 0; group = nextGroup(walk)) {
      for (int i = 0; i < tree_.size(group); ++i)
        meet(static_cast<std::size_t>(tree_.item(group, i)));
      walk.limit = limitOf(nearest.distance);
    }
  }

 private:
  WideTree tree_{2};
  std::vector<Box> boxes_;  ///< of the groups
};

}  // namespace vegetation_sim::scan

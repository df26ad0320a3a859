// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

/// A ball around trees, including their reach [m].
struct Ball {
  Vec3 centre{Vec3::Zero()};
  double reach{0.0};
};

/// The regions in which the trees of a forest stand, in a hierarchy of balls, so that what is far
/// away is passed over together. Takes about 55 bytes per region.
class TreeRegions {
 public:
  /// A single tree, or those of a tile.
  struct Region {
    Ball ball;
    std::uint32_t first, count;  ///< ids of trees
  };

  TreeRegions() = default;
  explicit TreeRegions(std::vector<Region> regions);

  /// Calls `visit` for the regions of which all balls around them satisfy `enter`, in an order that
  /// depends on the regions only. Balls of single trees are not tested. @param enter has to be true
  /// for a ball if it is true for any ball inside.
  template <class Enter, class Visit>
  void visit(const Enter& enter, const Visit& visit) const {
    if (!levels_.empty()) visitBalls(levels_.size() - 1, 0, levels_.back().size(), enter, visit);
  }

 private:
  static constexpr std::size_t CHILDREN = 8;

  template <class Enter, class Visit>
  void visitBalls(std::size_t level, std::size_t begin, std::size_t end, const Enter& enter,
                  const Visit& visit) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (!enter(levels_[level][i])) continue;
      const std::size_t first = i * CHILDREN;
      if (level > 0)
        visitBalls(level - 1, first, std::min(first + CHILDREN, levels_[level - 1].size()), enter,
                   visit);
      else
        for (std::size_t k = first; k < std::min(first + CHILDREN, regions_.size()); ++k)
          if (regions_[k].count == 1 || enter(regions_[k].ball)) visit(regions_[k]);
    }
  }

  std::vector<Region> regions_;            // along a Morton curve
  std::vector<std::vector<Ball>> levels_;  // each ball around CHILDREN of the level before
};

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// The trees of a layout outside tiles, sorted by square cells, to find those near a point. Takes
/// 12 bytes per tree.
class TreeGrid {
 public:
  TreeGrid() = default;
  explicit TreeGrid(const Layout& layout);
  /// Returns the ids of all trees that may reach into a ball, and of some others; sorted.
  std::vector<std::uint32_t> findCandidates(const Vec3& centre, double radius) const;

 private:
  double largest_size_{0.0};          // bound of the reach of any of the trees [m]
  std::vector<std::uint64_t> cells_;  // row and column, rising
  std::vector<std::uint32_t> trees_;  // of each entry of cells_
};

/// Does findTreesNear() with the grid of the layout, or without one if it is null.
std::vector<std::uint32_t> findTreesNear(const Layout& layout, const TreeGrid* grid,
                                         const terrain::HeightMap& terrain, const Vec3& centre,
                                         double radius);

}  // namespace vegetation_sim::forest

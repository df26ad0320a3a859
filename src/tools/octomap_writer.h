// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// Options of an octree.
struct OctomapRule {
  double resolution{0.1};                ///< edge of the smallest cells [m]
  double thinnest{0.05};                 ///< minimum radius at the base of branches [m]
  std::uint64_t most_cells{50'000'000};  ///< maximum number of cells that are examined
};
/// Adds a fault for each value out of range.
void check(const OctomapRule& rule, Faults& faults);

/// Writes the wood at rest as a binary OctoMap (.bt) in the world frame (N14). A cell that wood
/// touches is occupied, and so may be one whose middle is up to resolution sqrt(3)/2 beyond the
/// bark; all others are unknown. @return occupied cells of the smallest size.
/// @throws InvalidInput if the cells are too many or beyond the range of the octree, 32768 cells.
std::uint64_t writeOctomap(const Layout& layout, const terrain::HeightMap& terrain,
                           const OctomapRule& rule, std::ostream& out);

}  // namespace vegetation_sim::forest

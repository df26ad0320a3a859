// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// What of a forest other programs are told.
struct ExportRule {
  std::string name{"forest"};              ///< of the model
  double thinnest{0.05};                   ///< radius at the base of the thinnest wood told [m]
  std::uint64_t most_branches{1'000'000};  ///< in all; a model with more is refused
};
/// Adds a fault for whatever is out of range.
void check(const ExportRule& rule, Faults& faults);

/// The trees at rest as one static SDF model: a link a tree, a cylinder a branch, as thick as the
/// branch in its middle (N14). World frame. A tree too thin for the rule keeps its trunk's foot.
/// @return cylinders written. @throws InvalidInput if there are more than the rule allows.
std::uint64_t writeSdf(const Layout& layout, const terrain::HeightMap& terrain,
                       const ExportRule& rule, std::ostream& out);

/// A line a tree: number, species, foot [m], radius of the trunk at the foot [m], height [m].
void writeTable(const Layout& layout, const terrain::HeightMap& terrain, std::ostream& out);

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// Options of an export.
struct ExportRule {
  std::string name{"forest"};              ///< of the model, and of the folder that holds it
  double thinnest{0.05};                   ///< minimum radius at the base of exported branches [m]
  std::uint64_t most_branches{1'000'000};  ///< maximum in all; a model with more is rejected
};
/// Adds a fault for each value out of range.
void check(const ExportRule& rule, Faults& faults);

/// Writes the trees at rest as one static SDF model: a link per tree, a cylinder per branch with
/// the radius at its middle (N14), and unless the ground is flat a link with the mesh of
/// writeTerrain(). World frame. A tree below the minimum radius keeps the foot of its trunk.
/// @return cylinders written. @throws InvalidInput if there are more than allowed.
std::uint64_t writeSdf(const Layout& layout, const terrain::HeightMap& terrain,
                       const ExportRule& rule, std::ostream& out);

/// Writes the ground as a mesh in the format OBJ, whose vertices are its samples; of more than
/// `most` of them every second, third and so on, and the border. Between samples the ground has
/// other heights than its two facets, by a quarter of the twist of a cell at most. Requires ground
/// that is not flat.
/// @return distance between vertices [m].
double writeTerrain(const terrain::HeightMap& terrain, std::uint64_t most, std::ostream& out);

/// Writes one line per tree: number, species, foot [m], radius of the trunk at the foot [m], height
/// [m].
void writeTable(const Layout& layout, const terrain::HeightMap& terrain, std::ostream& out);

}  // namespace vegetation_sim::forest

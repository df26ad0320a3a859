// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grass/mesh/grass_geometry.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::view {

/// Where the next strip of a mesh begins.
struct StripsBegin {
  explicit StripsBegin(const grass::GrassMesh& mesh)
      : vertex(mesh.vertexCount()), index(mesh.indices.size()) {}
  std::size_t vertex, index;
};

/// Gives the strips of a tile random heights and lightnesses, lets their tops lean to both sides,
/// and lets fewer blades reach the ground, so that they do not look like fences from above.
void varyStrips(const grass::Tile& tile, const StripsBegin& begin, grass::GrassMesh& mesh);

/// Leaves a share of the strips of a tile: tufts with soft ends. What shows nothing is removed.
void thinStrips(const grass::Tile& tile, const StripsBegin& begin, double share,
                grass::GrassMesh& mesh);

/// Appends the four strips on the edges of a tile as appendStrips() does, but each is shifted from
/// its edge, shows a part of the picture of its own, and ends at random before or after the corner,
/// so that a meadow shows no grid. Tread and cuts are those of the place where a strip stands.
void appendShiftedStrips(const grass::FeatureMap& map, const terrain::HeightMap& terrain,
                         const grass::Tile& tile, const grass::TileMotion& motion, double grown,
                         double full_density, const grass::GrassLight& light,
                         grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grass/mesh/grass_geometry.h"

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

}  // namespace vegetation_sim::view

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/grass/blades/blade.h"
#include "vegetation_sim/grass/map/tile.h"

namespace vegetation_sim::grass {

constexpr int BLOCK = 16;  ///< blades stored side by side

/// Points of 16 blades [m], from the tile's south-west corner: point 0 is the root. 72 bytes a
/// blade. Blocks, not long rows: 18 rows that lie 2^k bytes apart would share a few cache lines.
struct alignas(64) BladeBlock {
  float x[POINTS][BLOCK], y[POINTS][BLOCK], z[POINTS][BLOCK];
};

/// How trodden a tile is at one instant: a grid of tilts, and tilts times their directions.
struct CrushPatch {
  int cells{0};                     ///< along each side; 0: untrodden
  std::vector<float> tilt, tx, ty;  ///< [(cells + 1) x (cells + 1)] [rad], south row first
};

/// What moves the blades of a tile at one instant.
struct TileMotion {
  Corners wind_x{}, wind_y{};        ///< air at the corners [m/s]
  const CrushPatch* crush{nullptr};  ///< none: untrodden
  BladeModel model{BladeModel::ARC};
};

/// Where a batch goes: CACHED if it is read soon, STREAMED past the caches if it is large and not.
enum class Store { CACHED, STREAMED };

/// Poses blades 0 to count - 1 of a tile, straight from its seed; `out` has room for count rounded
/// up to whole blocks, whose last blades are there but not of the tile. Blade i does not depend on
/// count, so the first n blades of a tile are an unbiased sample of all (S2-05, S2-06). Runs on the
/// widest vectors of the processor; the same bits on each of them and from the plain version.
/// Requires 0 <= count <= MAX_BLADES.
void poseBlades(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out,
                Store store = Store::CACHED);

/// Blocks that hold `count` blades.
constexpr int blocksFor(int count) {
  return (count + BLOCK - 1) / BLOCK;
}

}  // namespace vegetation_sim::grass

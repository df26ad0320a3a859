// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "vegetation_sim/grass/blades/blade.h"
#include "vegetation_sim/grass/map/tile.h"

namespace vegetation_sim::grass {

constexpr int BLOCK = 16;  ///< blades stored side by side

/// Points of 16 blades [m] relative to the tile's south-west corner; point 0 is the root. A blade
/// takes 72 bytes. Long rows would be slower: 18 rows that lie 2^k bytes apart share few cache
/// lines.
struct alignas(64) BladeBlock {
  float x[POINTS][BLOCK], y[POINTS][BLOCK], z[POINTS][BLOCK];
};

/// Longest blade where nothing was cut [m].
constexpr float UNCUT = 1e9f;

/// Trodden and cut ground of a tile at one instant: a grid of tilts, and of tilts times their
/// directions; and if any of it is cut, of the longest blades and the cut grass that lies there.
struct CrushPatch {
  int cells{0};                     ///< cells along each side; 0: neither trodden nor cut
  std::vector<float> tilt, tx, ty;  ///< [(cells + 1) x (cells + 1)] [rad], south row first
  std::vector<float> cut, swath;    ///< likewise [m], [kg/m^2]; empty if nothing is cut

  /// Returns the index of the node that is nearest to a place of the tile, in shares of its side.
  std::size_t nearest(float u, float v) const {
    const auto n = static_cast<float>(cells);
    const auto column = static_cast<std::size_t>(u * n + 0.5f);
    return static_cast<std::size_t>(v * n + 0.5f) * static_cast<std::size_t>(cells + 1) + column;
  }
};

/// The causes that bend the blades of a tile at one instant.
struct TileMotion {
  Corners wind_x{}, wind_y{};        ///< wind at the corners [m/s]
  const CrushPatch* crush{nullptr};  ///< null if untrodden
  BladeModel model{BladeModel::ARC};
};

/// CACHED writes through the caches, for a batch that is read soon. STREAMED writes past them.
enum class Store { CACHED, STREAMED };

/// Poses blades 0 to count - 1 of a tile from the tile's seed. `out` must have room for whole
/// blocks; the last block also gets blades that are not of the tile. Blade i does not depend on
/// count, so the first n blades are an unbiased sample of all (S2-05, S2-06). Uses the widest
/// vectors of the processor; the result has the same bits on each of them and in poseBladesPlain().
/// Requires 0 <= count <= MAX_BLADES.
void poseBlades(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out,
                Store store = Store::CACHED);

/// Returns the number of blocks that hold `count` blades.
constexpr int blocksFor(int count) {
  return (count + BLOCK - 1) / BLOCK;
}

}  // namespace vegetation_sim::grass

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/shards/shard_split.h"
#include "vegetation_sim/grass/map/feature_map.h"

namespace vegetation_sim::grass {

/// Which shard owns which tile of a meadow: a pure function of the map and the number of shards, so
/// that all processes agree. Takes 2 bytes per tile; none for one shard.
class TileOwners {
 public:
  /// One shard owns all tiles.
  TileOwners() = default;
  /// @throws InvalidInput for a shard that check() refuses.
  TileOwners(const MapLaw& law, const Shard& shard);

  const Shard& shard() const { return shard_; }
  /// Returns the owner of a tile; one beyond the map belongs to the owner of the nearest tile.
  std::uint32_t ownerOf(int tile_column, int tile_row) const;
  /// Returns the owner of the tile at a place [m].
  std::uint32_t ownerAt(double x, double y) const;
  /// Returns the owner of a TreadBlock: that of the tile at its middle. @param cells fine cells
  /// along a tile.
  std::uint32_t ownerOfBlock(int row, int column, int cells) const;
  /// Whether shard() owns a block or the tile at a place.
  bool ownsBlock(int row, int column, int cells) const {
    return shard_.count == 1 || ownerOfBlock(row, column, cells) == shard_.index;
  }
  bool ownsPlace(double x, double y) const {
    return shard_.count == 1 || ownerAt(x, y) == shard_.index;
  }

 private:
  Shard shard_;
  MapLaw law_;
  std::vector<std::uint16_t> owners_;  // of tiles, row by row from the south
};

}  // namespace vegetation_sim::grass

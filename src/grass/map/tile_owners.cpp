// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/map/tile_owners.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::grass {
namespace {

constexpr int BLOCK_SIDE = 16;  // as TreadBlock::SIDE

}  // namespace

TileOwners::TileOwners(const MapLaw& law, const Shard& shard) : shard_(shard), law_(law) {
  Faults faults;
  check(shard, faults);
  faults.throwIfAny();
  if (shard.count == 1) return;
  std::vector<ShardUnit> tiles;
  for (int row = 0; row < law.rows - 1; ++row)
    for (int column = 0; column < law.columns - 1; ++column)
      tiles.push_back({law.origin_x + (column + 0.5) * law.resolution,
                       law.origin_y + (row + 0.5) * law.resolution, 1});
  owners_ = assignShards(tiles, shard.count);
}

std::uint32_t TileOwners::ownerOf(int tile_column, int tile_row) const {
  if (shard_.count == 1) return 0;
  const int columns = law_.columns - 1;
  const int column = std::clamp(tile_column, 0, columns - 1);
  const int row = std::clamp(tile_row, 0, law_.rows - 2);
  return owners_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
}

std::uint32_t TileOwners::ownerAt(double x, double y) const {
  const auto tile = [&](double at, double origin) {
    return static_cast<int>(
        std::floor(std::min(1e8, std::max(-1.0, (at - origin) / law_.resolution))));
  };
  return ownerOf(tile(x, law_.origin_x), tile(y, law_.origin_y));
}

std::uint32_t TileOwners::ownerOfBlock(int row, int column, int cells) const {
  const auto tile = [&](int block) { return (block * BLOCK_SIDE + BLOCK_SIDE / 2) / cells; };
  return ownerOf(tile(column), tile(row));
}

}  // namespace vegetation_sim::grass

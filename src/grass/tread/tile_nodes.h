// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

namespace vegetation_sim::grass {

/// Calls `visit(node, index)` for each node of a tile's patch that is in one of the blocks (by row
/// and column) for which `begins(block)` is true; `index` counts row by row in the patch.
/// @param cells fine cells along a tile.
template <class Blocks, class Begins, class Visit>
void visitTileNodes(const Blocks& blocks, int tile_column, int tile_row, int cells, Begins begins,
                    Visit visit) {
  constexpr int SIDE = Blocks::mapped_type::SIDE;
  const int column0 = tile_column * cells, row0 = tile_row * cells;
  for (int block_row = row0 / SIDE; block_row <= (row0 + cells) / SIDE; ++block_row) {
    auto entry = blocks.lower_bound({block_row, column0 / SIDE});
    for (; entry != blocks.end() && entry->first.first == block_row &&
           entry->first.second <= (column0 + cells) / SIDE;
         ++entry) {
      if (!begins(entry->second)) continue;
      const int first_row = block_row * SIDE, first_column = entry->first.second * SIDE;
      for (int row = std::max(row0, first_row); row <= std::min(row0 + cells, first_row + SIDE - 1);
           ++row)
        for (int column = std::max(column0, first_column);
             column <= std::min(column0 + cells, first_column + SIDE - 1); ++column)
          visit(entry->second.nodes[static_cast<std::size_t>((row - first_row) * SIDE + column -
                                                             first_column)],
                static_cast<std::size_t>(row - row0) * static_cast<std::size_t>(cells + 1) +
                    static_cast<std::size_t>(column - column0));
    }
  }
}

}  // namespace vegetation_sim::grass

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/shards/tree_owners.h"

#include <algorithm>

namespace vegetation_sim::forest {
// Trees outside tiles and whole tiles are owned as a whole; of equal places, trees come first.
TreeOwners::TreeOwners(const Layout& layout, const Shard& shard)
    : shard_(shard), owned_(layout.treeCount()) {
  Faults faults;
  check(shard, faults);
  faults.throwIfAny();
  if (shard.count == 1) return;
  std::vector<ShardUnit> units;
  units.reserve(layout.trees.size() + layout.tiles.size());
  for (const TreeSeed& seed : layout.trees)
    units.push_back({seed.position.x(), seed.position.y(), 1});
  for (const Tile& tile : layout.tiles)
    units.push_back({tile.x + 0.5 * tile.size, tile.y + 0.5 * tile.size, tile.count});
  trees_ = assignShards(units, shard.count);
  owned_ = 0;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (trees_[i] == shard.index) owned_ += units[i].weight;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i)
    tiles_.push_back({layout.tiles[i].first_tree, trees_[layout.trees.size() + i]});
  trees_.resize(layout.trees.size());
  trees_.shrink_to_fit();
}

std::uint32_t TreeOwners::ownerOf(std::uint32_t tree) const {
  if (shard_.count == 1) return 0;
  if (tree < trees_.size()) return trees_[tree];
  const auto after = std::upper_bound(
      tiles_.begin(), tiles_.end(), tree,
      [](std::uint32_t id, const TileOwner& tile) { return id < tile.first_tree; });
  return after == tiles_.begin() ? 0 : std::prev(after)->owner;
}

void TreeOwners::requireOwned(const std::string& what, std::uint32_t tree) const {
  if (owns(tree)) return;
  throw InvalidInput(what + ": tree = " + std::to_string(tree) + " belongs to shard " +
                         std::to_string(ownerOf(tree)) + " of " + std::to_string(shard_.count) +
                         ", this is shard " + std::to_string(shard_.index),
                     FaultCode::UNKNOWN);
}

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/tree_owners.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

constexpr double ORIGIN = -2e7;           // of the Morton cells [m], beyond all trees
constexpr double LAST_CELL = 67108863.0;  // 2^26 - 1; a cell is a square of 1 m

// A tree outside tiles, or a tile.
struct OwnedUnit {
  std::uint64_t key;
  std::uint32_t index, trees;
  bool is_tile;
};

// Puts a zero bit before each bit.
std::uint64_t spreadBits(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffffULL;
  x = (x | x << 8) & 0x00ff00ff00ff00ffULL;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fULL;
  x = (x | x << 2) & 0x3333333333333333ULL;
  return (x | x << 1) & 0x5555555555555555ULL;
}

std::uint64_t mortonKey(double x, double y) {
  const auto cell = [](double at) {
    return static_cast<std::uint64_t>(std::clamp(std::floor(at - ORIGIN), 0.0, LAST_CELL));
  };
  return spreadBits(cell(x)) | spreadBits(cell(y)) << 1;
}

// Lists what is owned as a whole along the curve; of equal places, trees before tiles, by index.
std::vector<OwnedUnit> listUnits(const Layout& layout) {
  std::vector<OwnedUnit> out;
  out.reserve(layout.trees.size() + layout.tiles.size());
  for (const TreeSeed& seed : layout.trees)
    out.push_back({mortonKey(seed.position.x(), seed.position.y()),
                   static_cast<std::uint32_t>(out.size()), 1, false});
  std::uint32_t index = 0;
  for (const Tile& tile : layout.tiles)
    out.push_back(
        {mortonKey(tile.x + 0.5 * tile.size, tile.y + 0.5 * tile.size), index++, tile.count, true});
  std::stable_sort(out.begin(), out.end(),
                   [](const OwnedUnit& a, const OwnedUnit& b) { return a.key < b.key; });
  return out;
}

}  // namespace

void check(const Shard& shard, Faults& faults) {
  if (shard.count < 1 || shard.count > MOST_SHARDS)
    faults.add("shard: count = " + std::to_string(shard.count) + " is outside 1 to " +
               std::to_string(MOST_SHARDS));
  else if (shard.index >= shard.count)
    faults.add("shard: index = " + std::to_string(shard.index) + " is outside 0 to " +
               std::to_string(shard.count - 1) +
               ", because count = " + std::to_string(shard.count));
}

std::uint32_t nextIdOf(const Shard& shard, std::uint32_t least) {
  const std::uint32_t over = (least - 1) % shard.count;
  return least + (shard.index + shard.count - over) % shard.count;
}

// A unit belongs to the shard into whose stretch the middle of its trees falls.
TreeOwners::TreeOwners(const Layout& layout, const Shard& shard)
    : shard_(shard), owned_(layout.treeCount()) {
  Faults faults;
  check(shard, faults);
  faults.throwIfAny();
  if (shard.count == 1) return;
  trees_.resize(layout.trees.size());
  for (const Tile& tile : layout.tiles) tiles_.push_back({tile.first_tree, 0});
  const std::uint64_t twice_all = 2 * std::uint64_t{layout.treeCount()};
  std::uint64_t before = 0;
  owned_ = 0;
  for (const OwnedUnit& unit : listUnits(layout)) {
    const std::uint64_t middle = 2 * before + unit.trees;
    const auto owner = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        middle * shard.count / std::max<std::uint64_t>(1, twice_all), shard.count - 1));
    if (unit.is_tile)
      tiles_[unit.index].owner = owner;
    else
      trees_[unit.index] = static_cast<std::uint16_t>(owner);
    before += unit.trees;
    if (owner == shard.index) owned_ += unit.trees;
  }
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

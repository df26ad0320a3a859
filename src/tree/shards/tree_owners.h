// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/shards/shard_split.h"
#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// Which shard owns which tree: a pure function of the layout and the number of shards, so that all
/// processes agree. Trees outside tiles and whole tiles lie in a row along a Morton curve through
/// their feet and centres; shards have successive stretches of it with about equal numbers of
/// trees. Takes 2 bytes per tree outside tiles and 8 per tile; none for one shard.
class TreeOwners {
 public:
  /// One shard owns all trees.
  TreeOwners() = default;
  /// @throws InvalidInput for a shard that check() refuses.
  TreeOwners(const Layout& layout, const Shard& shard);

  const Shard& shard() const { return shard_; }
  /// Returns the index of the shard that owns a tree of the layout.
  std::uint32_t ownerOf(std::uint32_t tree) const;
  /// Returns whether shard() owns a tree of the layout.
  bool owns(std::uint32_t tree) const { return shard_.count == 1 || ownerOf(tree) == shard_.index; }
  /// Returns the number of trees of shard().
  std::uint32_t countOwned() const { return owned_; }
  /// @throws InvalidInput that names a tree of another shard and its owner. @param what what the
  /// text begins with.
  void requireOwned(const std::string& what, std::uint32_t tree) const;

 private:
  struct TileOwner {
    std::uint32_t first_tree, owner;
  };
  Shard shard_;
  std::uint32_t owned_{0};
  std::vector<std::uint16_t> trees_;  // owner of each tree outside tiles
  std::vector<TileOwner> tiles_;      // by first tree, rising
};

}  // namespace vegetation_sim::forest

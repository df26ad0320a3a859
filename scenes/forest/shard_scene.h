// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {

/// Four tiles of 8 m with 64 young trees each around the origin, and 16 trees outside tiles that
/// stand over their borders.
inline Layout fourTiles() {
  Layout out;
  Design young;
  young.children = 0.5;
  for (const char* name : {"birch", "pine"}) {
    out.species.push_back(applyDesign(applyStage(shippedSpecies(name), 0.3), young));
    out.species.back().name = name;
  }
  for (std::uint32_t i = 0; i < 16; ++i) {
    TreeSeed seed;
    seed.seed = 100 + i;
    seed.species = static_cast<std::uint16_t>(i % 2);
    const double along = -7.0 + 14.0 * (i / 2) / 7.0;
    seed.position = i % 2 ? Vec3(along, 0.3, 0.0) : Vec3(-0.3, along, 0.0);
    seed.yaw = 0.4 * i;
    out.trees.push_back(seed);
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    Tile tile;
    tile.first_tree = 16 + 64 * i;
    tile.count = 64;
    tile.seed = 11 + i;
    tile.x = i % 2 ? 0.0 : -8.0;
    tile.y = i / 2 ? 0.0 : -8.0;
    tile.size = 8.0;
    tile.mix = {1.f, 1.f};
    out.tiles.push_back(tile);
  }
  return out;
}

/// One forest in `count` shards, whose inputs go to all of them, or to the owner of a tree.
class ShardedForest {
 public:
  ShardedForest(const Layout& layout, const Settings& settings, std::uint32_t count) {
    for (std::uint32_t index = 0; index < count; ++index)
      shards_.emplace_back(layout, flatTerrain(), settings, Shard{index, count});
  }

  std::vector<Forest>& shards() { return shards_; }
  Forest& ownerOf(std::uint32_t tree) { return shards_[shards_[0].owners().ownerOf(tree)]; }
  template <class Call>
  void all(const Call& call) {
    for (Forest& shard : shards_) call(shard);
  }
  /// Names a grab, because shards give other ids than one forest does.
  void grab(const std::string& name, const Grab& grab) {
    grabs_[name] = {grab.point.tree, ownerOf(grab.point.tree).addGrab(grab)};
  }
  void move(const std::string& name, const Vec3& target) {
    ownerOf(grabs_[name].tree).moveGrab(grabs_[name].id, target);
  }
  void release(const std::string& name) {
    ownerOf(grabs_[name].tree).release(grabs_[name].id);
    grabs_.erase(name);
  }
  std::uint32_t idOf(const std::string& name) const { return grabs_.at(name).id; }
  /// Returns the sum of the hashes of all shards.
  std::uint64_t treesHash() const {
    std::uint64_t out = 0;
    for (const Forest& shard : shards_) out += shard.treesHash();
    return out;
  }

 private:
  struct HeldBy {
    std::uint32_t tree, id;
  };
  std::vector<Forest> shards_;
  std::map<std::string, HeldBy> grabs_;
};

}  // namespace vegetation_sim::forest

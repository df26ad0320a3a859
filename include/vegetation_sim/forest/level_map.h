// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "vegetation_sim/forest/level.h"

namespace vegetation_sim::forest {

/// Levels of all trees of a forest; only those that differ from the base take memory.
class LevelMap {
 public:
  int base() const { return base_; }
  /// Level of a tree; a tree that is not held is settled at the base.
  LevelState of(std::uint32_t tree) const;
  const std::map<std::uint32_t, LevelState>& held() const { return held_; }

  void set(std::uint32_t tree, const LevelState& state) { held_[tree] = state; }
  /// Drops every tree and gives all of them the base level.
  void reset(int base);
  /// Changes the base without changing any tree: the `count` trees that rested on the old one are
  /// held from now on.
  void rebase(int base, std::uint32_t count);
  /// Forgets the trees that have settled at the base.
  void prune(Nanoseconds stamp, double transition);
  /// Hash of levels at `stamp`, the same whether or not pruned.
  void addTo(Hash& hash, Nanoseconds stamp, double transition) const;

 private:
  bool resting(const LevelState& state, Nanoseconds stamp, double transition) const;

  int base_{0};
  std::map<std::uint32_t, LevelState> held_;
};

/// State message of a forest in core terms; ros/forest_conversions.h has its ROS twin.
struct StateUpdate {
  Nanoseconds stamp{0};
  std::uint32_t sequence{0};
  bool key_frame{true};
  int base_level{0};
  std::uint64_t layout_hash{0}, wind_hash{0}, hash{0};
  struct Entry {
    std::uint32_t tree{0};
    LevelState state;
  };
  std::vector<Entry> trees;
};

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "vegetation_sim/tree/motion/motion_level.h"
#include "vegetation_sim/tree/state/promoted_branches.h"

namespace vegetation_sim::forest {

class TreeHashes;

/// Levels of all trees of a forest. Only trees that differ from the base take memory. The base may
/// itself be in transition, so that a million trees change at the cost of one.
class LevelMap {
 public:
  const LevelState& base() const { return base_; }
  /// Returns the level of a tree; the base for a tree that is not held.
  LevelState of(std::uint32_t tree) const;
  const std::map<std::uint32_t, LevelState>& held() const { return held_; }
  /// Returns how many of `trees` are at each level.
  std::array<std::size_t, MODAL_LEVEL + 1> counts(std::size_t trees) const;

  void set(std::uint32_t tree, const LevelState& state) { held_[tree] = state; }
  /// Makes a tree follow the base.
  void resetToBase(std::uint32_t tree) { held_.erase(tree); }
  /// Sets the base and makes every tree follow it.
  void reset(const LevelState& base);
  void setBase(const LevelState& base) { base_ = base; }
  /// Starts a transition of the base to `level`; held trees keep their levels.
  void changeBase(int level, Nanoseconds stamp, double transition);
  /// Restarts every transition from its current blend, so that its duration may change.
  void anchor(Nanoseconds stamp, double transition);
  /// Removes the trees that have settled at the settled base.
  void prune(Nanoseconds stamp, double transition);
  /// Adds the levels at `stamp` to a hash, which does not depend on prune().
  void addTo(Hash& hash, Nanoseconds stamp, double transition) const;
  /// Adds the levels of the trees that are not at the base, likewise.
  void addTo(TreeHashes& hashes, Nanoseconds stamp, double transition) const;

 private:
  bool isAtBase(const LevelState& state, Nanoseconds stamp, double transition) const;

  LevelState base_;
  std::map<std::uint32_t, LevelState> held_;
};

/// State message of a forest in types of the core; ros/forest_conversions.h converts it.
struct StateUpdate {
  Nanoseconds stamp{0};
  std::uint32_t sequence{0};
  bool key_frame{true};
  LevelState base;    ///< of all trees that are not listed
  double blend{1.5};  ///< duration of blends from physical to procedural [s]
  std::uint64_t layout_hash{0}, wind_hash{0}, hash{0};
  std::uint64_t trees_hash{0};  ///< see Forest::treesHash(); 0 without shards
  /// The shard whose trees it contains, and their number. 0 or 1 shards: it contains all trees.
  std::uint32_t shard{0}, shards{1};
  struct Entry {
    std::uint32_t tree{0};
    LevelState state;
    std::vector<PromotedBranch> promoted{};  ///< sorted by branch; empty: none
    /// Modal state, in key frames and at the start of modes; empty: replicas step it.
    physics::ModalState modal{};
    BrokenBranches broken{};  ///< everything that has come off the tree
  };
  std::vector<Entry> trees;
};

}  // namespace vegetation_sim::forest

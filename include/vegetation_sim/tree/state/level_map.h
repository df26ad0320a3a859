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

/// Levels of all trees of a forest; only those that differ from the base take memory. The base too
/// may be on its way from one level to another: a million trees change together for the price of
/// one.
class LevelMap {
 public:
  const LevelState& base() const { return base_; }
  /// Level of a tree; one that is not held has the base's.
  LevelState of(std::uint32_t tree) const;
  const std::map<std::uint32_t, LevelState>& held() const { return held_; }
  /// How many of `trees` are at each level.
  std::array<std::size_t, MODAL_LEVEL + 1> counts(std::size_t trees) const;

  void set(std::uint32_t tree, const LevelState& state) { held_[tree] = state; }
  /// Gives a tree the base's level, now and later.
  void resetToBase(std::uint32_t tree) { held_.erase(tree); }
  /// Drops every tree and gives all of them the base's level.
  void reset(const LevelState& base);
  void setBase(const LevelState& base) { base_ = base; }
  /// Starts a change of the base to `level`; the trees that are held keep theirs.
  void changeBase(int level, Nanoseconds stamp, double transition);
  /// Restarts every change from where it stands, so that its duration may change.
  void anchor(Nanoseconds stamp, double transition);
  /// Forgets the trees that have settled at the base, once it has settled itself.
  void prune(Nanoseconds stamp, double transition);
  /// Hash of levels at `stamp`, the same whether or not pruned.
  void addTo(Hash& hash, Nanoseconds stamp, double transition) const;

 private:
  LevelState base_;
  std::map<std::uint32_t, LevelState> held_;
};

/// State message of a forest in core terms; ros/forest_conversions.h has its ROS twin.
struct StateUpdate {
  Nanoseconds stamp{0};
  std::uint32_t sequence{0};
  bool key_frame{true};
  LevelState base;    ///< of every tree that is not listed
  double blend{1.5};  ///< duration of blends from physical to procedural [s]
  std::uint64_t layout_hash{0}, wind_hash{0}, hash{0};
  struct Entry {
    std::uint32_t tree{0};
    LevelState state;
    std::vector<PromotedBranch> promoted{};  ///< by rising branch; none
    /// Of its modes, in key frames and when they begin; empty: as steps from then on have it.
    physics::ModalState modal{};
  };
  std::vector<Entry> trees;
};

}  // namespace vegetation_sim::forest

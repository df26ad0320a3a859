// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "vegetation_sim/forest/physics/modal_forest.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/tree/state/promoted_branches.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

class TreeOwners;

/// Rebuilds the forest of forest_animator from messages: layout, wind and state in, the pose of
/// every branch out, with equal values. A forest in shards has as many series of messages, which
/// are tracked one by one and change the trees of their shard only. Messages set the number of
/// shards while none is in step, as after setLayout() and forgetState(), or all are silent.
class ForestReplica {
 public:
  /// When the fine modes of trees are computed that are in a message for the first time; it takes
  /// some tens of milliseconds a tree.
  enum class FineModes {
    AT_ONCE,    ///< in apply(), which sensors need; of up to 64 trees, the others ONE_BY_ONE
    ONE_BY_ONE  ///< one tree per 0.1 s, so that no frame is late; others move procedurally until
                ///< then
  };
  explicit ForestReplica(FineModes fine_modes = FineModes::AT_ONCE) : fine_modes_(fine_modes) {}

  /// @throws InvalidInput for a layout that check() refuses.
  void setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain);
  void setWind(const wind::Field& wind) { wind_ = wind; }
  /// Applies a key frame or the next delta; modal trees are stepped to its stamp in the current
  /// wind. Returns false if messages were lost or belong to another layout; trees are then ignored
  /// until the next key frame, and why() returns the reason.
  /// @throws InvalidInput, and then nothing has changed, for a tree or a branch that the layout
  /// does not have, for a tree of another shard, and for another number of shards than before.
  bool apply(const StateUpdate& update);
  const std::string& why() const { return why_; }

  /// Brings all trees to rest, whole, until the next key frame, because time jumped back.
  void forgetState();

  bool ready() const { return layout_ != nullptr; }
  const Layout& layout() const { return *layout_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  std::shared_ptr<const terrain::HeightMap> terrainPtr() const { return terrain_; }
  const wind::Field& wind() const { return wind_; }
  LevelState levelOf(std::uint32_t tree) const { return partOf(tree).levels.of(tree); }
  /// Returns the stamp that all shards have reached; 0 if one has not begun.
  Nanoseconds stamp() const;
  /// Returns the number of shards; 1 if the forest is not in shards, or nothing has arrived yet.
  std::uint32_t shards() const { return static_cast<std::uint32_t>(parts_.size()); }
  /// Returns the stamp of the last message of a shard, and whether all before it have arrived.
  Nanoseconds stampOf(std::uint32_t shard) const { return parts_.at(shard).stamp; }
  bool isInStep(std::uint32_t shard) const { return parts_.at(shard).in_sequence; }
  std::uint64_t layoutHash() const { return layout_hash_; }

  /// Grows a tree without what has come off it.
  Tree grow(std::uint32_t tree) const {
    return growTree(*layout_, tree, *terrain_, brokenOf(broken_, tree));
  }
  /// Returns the branches that have come off the trees.
  const BrokenTrees& broken() const { return broken_; }
  Weights weights(std::uint32_t tree, Nanoseconds stamp) const {
    return weightsAt(levelOf(tree), stamp, layout_->motion);
  }
  /// Returns the physical joints of a tree at the stamp of its shard; `branches` is empty if there
  /// are none.
  PromotedTree promoted(std::uint32_t tree) const;
  /// Returns the ids of the trees that have physical joints, sorted.
  std::vector<std::uint32_t> physicalTrees() const;
  /// Returns the modal state of a tree, or nullptr if it has none yet; see FineModes.
  const ModalTreeState* modalState(std::uint32_t tree) const {
    return partOf(tree).modes.find(tree);
  }
  /// Returns the pose of every branch in the tree's frame, physical joints and modes included, in
  /// double precision.
  std::vector<Pose> pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const;

 private:
  /// State from the messages of one shard, or from all if the forest is not in shards.
  struct Part {
    LevelMap levels;
    std::map<std::uint32_t, std::vector<PromotedBranch>> promoted;
    ModalForest modes;
    double blend{1.5};
    bool in_sequence{false};
    std::uint32_t sequence{0};
    Nanoseconds stamp{0};
  };

  const Part& partOf(std::uint32_t tree) const {
    return parts_.size() == 1 ? parts_.front() : parts_[shardOf(tree)];
  }
  std::size_t shardOf(std::uint32_t tree) const;
  Part& choosePart(const StateUpdate& update);
  bool fitsLayout(const StateUpdate& update);
  bool updateModes(const StateUpdate& update, Part& part);
  void restoreModes(const StateUpdate& update, Part& part);
  void updateBroken(const StateUpdate& update, Part& part);

  FineModes fine_modes_;
  std::shared_ptr<const Layout> layout_;
  std::shared_ptr<const terrain::HeightMap> terrain_;
  std::uint64_t layout_hash_{0};
  wind::Field wind_;
  std::vector<Part> parts_{1};                          // by shard; at least one
  std::shared_ptr<const TreeOwners> owners_;            // of parts_; null for one
  std::map<std::uint32_t, std::size_t> branch_counts_;  // of trees that were physical once
  BrokenTrees broken_;
  std::string why_{"no key frame yet"};
};

}  // namespace vegetation_sim::forest

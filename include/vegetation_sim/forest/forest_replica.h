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

/// The forest as any other process rebuilds it: layout, wind and state messages in, every branch
/// out, equal to what forest_animator computes.
class ForestReplica {
 public:
  /// @throws InvalidInput for a layout that check() refuses.
  void setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain);
  void setWind(const wind::Field& wind) { wind_ = wind; }
  /// Takes a key frame, or the delta that follows what is held; trees in modes are stepped to its
  /// stamp in the wind that is held. False: `trees` are ignored until
  /// the next key frame, because messages were lost or belong to another layout; why() says which.
  bool apply(const StateUpdate& update);
  const std::string& why() const { return why_; }

  /// Brings all trees to rest until the next key frame, because time jumped back.
  void forgetState();

  bool ready() const { return layout_ != nullptr; }
  const Layout& layout() const { return *layout_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  std::shared_ptr<const terrain::HeightMap> terrainPtr() const { return terrain_; }
  const wind::Field& wind() const { return wind_; }
  const LevelMap& levels() const { return levels_; }
  Nanoseconds stamp() const { return stamp_; }
  std::uint64_t layoutHash() const { return layout_hash_; }

  Tree grow(std::uint32_t tree) const { return growTree(*layout_, tree, *terrain_); }
  Weights weights(std::uint32_t tree, Nanoseconds stamp) const {
    return weightsAt(levels_.of(tree), stamp, layout_->motion);
  }
  /// Physical joints of a tree at stamp(); none: `branches` is empty.
  PromotedTree promoted(std::uint32_t tree) const;
  /// Trees that have physical joints, rising.
  std::vector<std::uint32_t> physicalTrees() const;
  /// Nullptr: the tree does not modal_state in modes, or they are still to be found: who joins late
  /// finds fine ones of one tree every 0.1 s, and shows the others procedural.
  const ModalTreeState* modalState(std::uint32_t tree) const { return modes_.find(tree); }
  /// Every branch in the tree's frame, physical ones and modes included, double precision.
  std::vector<Pose> pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const;

 private:
  bool updateModes(const StateUpdate& update);
  void restoreModes(const StateUpdate& update);

  std::shared_ptr<const Layout> layout_;
  std::shared_ptr<const terrain::HeightMap> terrain_;
  std::uint64_t layout_hash_{0};
  wind::Field wind_;
  LevelMap levels_;
  std::map<std::uint32_t, std::vector<PromotedBranch>> promoted_;
  ModalForest modes_;
  double blend_{1.5};
  bool in_sequence_{false};
  std::uint32_t sequence_{0};
  Nanoseconds stamp_{0};
  std::string why_{"no key frame yet"};
};

}  // namespace vegetation_sim::forest

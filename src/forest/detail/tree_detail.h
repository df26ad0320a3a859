// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>

#include "vegetation_sim/forest/physics/modal_forest.h"
#include "vegetation_sim/tree/state/level_map.h"

namespace vegetation_sim::forest {

/// A large tree whose modes are computed on another thread, and when they start.
struct ModesRequest {
  std::uint32_t tree{0};
  bool fine{false};
  Nanoseconds due{0};
};

/// Levels and modes of all trees for one group of listeners, and what updates for them have to
/// contain. A value: a copy is a snapshot.
struct TreeDetail {
  LevelMap levels;
  ModalForest modes;
  std::set<std::uint32_t> changed;  ///< trees of the next update
  std::set<std::uint32_t>
      begun;                  ///< of these, trees with new modes; the update has their amplitudes
  std::uint32_t sequence{0};  ///< of the next update
  std::optional<ModesRequest> request;

  /// Settles all trees at a level without modes.
  void reset(int level);
  void setLevel(std::uint32_t tree, int level, Nanoseconds stamp, double transition);
  /// Empties `changed` and `begun`.
  void forgetChanges();
  /// Removes what has no more effect at `stamp`.
  void prune(Nanoseconds stamp, double transition);
  /// Takes note that a tree has lost branches: the next update contains it, with its new modes,
  /// which are returned if there are any.
  /// @param at null: the modes end.
  /// @param like see ModalForest::addTree().
  const ModalTreeState* loseBranches(const ModalContext* at, std::uint32_t tree,
                                     const ModalTreeState* like);
  /// Completes an update, whose stamp is set, by the detail of the trees with physical joints and
  /// of those that have lost branches or are not at the base, or that have changed since the last
  /// update.
  void addTo(StateUpdate& update, const std::vector<std::uint32_t>& physical,
             const BrokenTrees& broken,
             const std::function<PromotedTree(std::uint32_t tree)>& promoted);
};

}  // namespace vegetation_sim::forest

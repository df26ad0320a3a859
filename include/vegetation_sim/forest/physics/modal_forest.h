// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/tree/modal/modal_tree_state.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::forest {

class TreeHashes;

/// The surroundings of modal trees. ModalForest keeps none of it.
struct ModalContext {
  const Layout& layout;
  const terrain::HeightMap& terrain;
  const wind::Field& wind;
  const BrokenTrees* broken{nullptr};  ///< what has come off the trees; null: nothing
};

/// The modal states of the trees of a forest. Forest and replica step them with the same code, so
/// amplitudes are sent in key frames only. A value: a copy is a snapshot.
class ModalForest {
 public:
  /// Rate of modal steps [Hz]; a tick takes the nearest whole number of steps.
  static constexpr int RATE = 60;

  /// Steps from the last tick to this one. All trees restart on their procedural motion after a gap
  /// that is not stepped through or when time has gone back; so does a tree whose state has another
  /// stamp.
  void advance(const wind::Field& wind, Nanoseconds from, Nanoseconds to);
  /// Starts a tree on its procedural motion. Computing its modes takes a few milliseconds, fine
  /// modes some tens. A tree in plain modes continues in fine ones.
  /// @param like has the same modes of the same tree, which are then shared; null: computes them.
  void addTree(const ModalContext& at, std::uint32_t tree, bool fine, Nanoseconds stamp,
               const ModalTreeState* like = nullptr);
  /// Returns true if one tree may get fine modes in this tick. Computing them takes longer than a
  /// tick, so one tree gets them every 0.1 s; replicas keep the same pace.
  static bool fineDue(Nanoseconds from, Nanoseconds to) {
    constexpr Nanoseconds PAUSE = NANOSECONDS_PER_SECOND / 10;
    return from / PAUSE != to / PAUSE;
  }
  /// Returns true if a state of so many modes can be restored without computing fine modes.
  bool isReady(std::uint32_t tree, std::size_t modes) const;
  /// Queues a tree for the computation of its fine modes; it has no modal state until one is
  /// restored.
  void queueFineModes(std::uint32_t tree);
  /// Computes the fine modes of one queued tree, for a state that arrives later.
  void prepareNext(const ModalContext& at);
  /// Sets the state of a tree. Modes that are held or prepared are not computed again.
  /// @throws InvalidInput for a tree without modes, or with another number of them.
  void restore(const ModalContext& at, std::uint32_t tree, const physics::ModalState& state,
               Nanoseconds stamp);
  /// Removes the trees whose modes have lost all weight.
  void removeFaded(const LevelMap& levels, Nanoseconds stamp, double transition);
  void retain(const std::set<std::uint32_t>& trees);
  /// Continues a tree that has lost branches in its new, plain modes, with the bends and rates that
  /// it has; returns its state, or nullptr for a tree without modes.
  /// @param like as in addTree().
  const ModalTreeState* replaceModes(const ModalContext& at, std::uint32_t tree,
                                     const ModalTreeState* like);
  /// Removes a tree, because it has lost branches and with them its modes.
  void removeTree(std::uint32_t tree);
  void clear();
  /// Returns a tree at rest with so many modes. @throws InvalidInput if it has another number.
  using ModesOf = std::function<ModalTreeState(std::uint32_t tree, std::size_t modes)>;
  /// A tree at rest whose modes are computed here.
  static ModalTreeState computeModes(const ModalContext& at, std::uint32_t tree, std::size_t modes);
  /// Returns a function that computes the modes which addTree() would give a tree, at rest. It
  /// needs nothing of the context any more and may be called on any thread.
  static std::function<ModalTreeState()> prepareModes(const ModalContext& at, std::uint32_t tree,
                                                      bool fine);
  /// Writes or reads the states of all trees. @param trees number of trees of the layout.
  void archive(Archive& a, std::size_t trees, const ModesOf& modes_of);

  /// Returns nullptr if the tree has no modal state.
  const ModalTreeState* find(std::uint32_t tree) const;
  /// Returns nullptr also if the tree has other modes than those that addTree() would give it.
  const ModalTreeState* find(std::uint32_t tree, bool fine) const;
  const std::map<std::uint32_t, ModalTreeState>& modalStates() const { return modal_states_; }
  std::size_t bytes() const;  ///< of all computed modes
  /// Number of trees that bend farther than modes are valid (physics::MODAL_LIMIT). Their bends are
  /// limited as those of other joints are.
  std::size_t countStrained() const;
  void addTo(Hash& hash) const;
  void addTo(TreeHashes& hashes) const;

 private:
  void refine(const wind::Field& wind, ModalTreeState fine, ModalTreeState& modal_state);
  void start(const wind::Field& wind, ModalTreeState& modal_state, Nanoseconds stamp);
  template <class Wanted>
  void retainIf(const Wanted& wanted);

  std::map<std::uint32_t, ModalTreeState> modal_states_;
  std::map<std::uint32_t, ModalTreeState> prepared_;  // computed before their state arrives
  std::set<std::uint32_t> awaited_;                   // trees whose fine modes are not computed yet
  std::vector<wind::Instant> instants_;               // scratch, as is the next
  std::vector<ModalLoad> loads_;
};

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/tree/modal/modal_tree_state.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// Where trees in modes stand: nothing of it is kept.
struct ModalContext {
  const Layout& layout;
  const terrain::HeightMap& terrain;
  const wind::Field& wind;
};

/// The trees of a forest that modal_state in modes. Forest and replica step them with this same
/// code, so that between key frames nobody needs to be told of amplitudes. A value: copy it to
/// save.
class ModalForest {
 public:
  /// Wind is looked at so often [Hz]; a tick takes the nearest whole number of such steps.
  static constexpr int RATE = 60;

  /// From the last tick to this one. After a gap that is not stepped through, and when time has
  /// gone back, every tree starts again on its procedural motion; so does one that stands
  /// elsewhere.
  void advance(const wind::Field& wind, Nanoseconds from, Nanoseconds to);
  /// Takes a tree up, on its procedural motion: finds its modes, a few milliseconds; fine ones take
  /// some tens. One in plain modes goes on in fine ones, which can do all that it does.
  void addTree(const ModalContext& at, std::uint32_t tree, bool fine, Nanoseconds stamp);
  /// Fine modes take longer to find than a tick: one tree gets some every 0.1 s, for who draws too.
  static bool fineDue(Nanoseconds from, Nanoseconds to) {
    constexpr Nanoseconds PAUSE = NANOSECONDS_PER_SECOND / 10;
    return from / PAUSE != to / PAUSE;
  }
  /// Whether a state of so many modes can be taken over at once, or without finding fine ones.
  bool isReady(std::uint32_t tree, std::size_t modes) const;
  /// A tree whose fine modes are to be found; until a state of it is restored it has none.
  void queueFineModes(std::uint32_t tree);
  /// Finds the fine modes of one awaited tree, for a state that is told later.
  void prepareNext(const ModalContext& at);
  /// Takes over a state that was told; modes that are held or prepared are not found again.
  /// @throws InvalidInput for a tree without modes, or with another number of them.
  void restore(const ModalContext& at, std::uint32_t tree, const physics::ModalState& state,
               Nanoseconds stamp);
  /// Drops the trees whose modes have no weight any more, nor will have.
  void removeFaded(const LevelMap& levels, Nanoseconds stamp, double transition);
  void retain(const std::set<std::uint32_t>& trees);
  void clear();

  /// Nullptr: not in modes.
  const ModalTreeState* find(std::uint32_t tree) const;
  const std::map<std::uint32_t, ModalTreeState>& modal_states() const { return modal_states_; }
  std::size_t bytes() const;  ///< of all that was found
  /// Trees that bend farther than modes hold (physics::MODAL_LIMIT). They saturate: joints stop at
  /// their limit, and nothing else is as near to the full chain at this cost.
  std::size_t countStrained() const;
  void addTo(Hash& hash) const;

 private:
  void refine(const ModalContext& at, std::uint32_t tree, ModalTreeState& modal_state);
  void start(const wind::Field& wind, ModalTreeState& modal_state, Nanoseconds stamp);
  template <class Wanted>
  void retainIf(const Wanted& wanted);

  std::map<std::uint32_t, ModalTreeState> modal_states_;
  std::map<std::uint32_t, ModalTreeState> prepared_;  // found, not told of yet
  std::set<std::uint32_t> awaited_;                   // still to be found
  std::vector<wind::Instant> instants_;               // scratch from here on
  std::vector<ModalLoad> loads_;
};

}  // namespace vegetation_sim::forest

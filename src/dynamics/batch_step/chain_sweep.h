// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/batch_step/chain_fill.h"
#include "dynamics/batch_step/chain_levels.h"
#include "dynamics/batch_step/chain_rows.h"

namespace vegetation_sim::physics {

/// Trees that step together, small enough for the second-level cache unless one is larger.
struct ChainGroup {
  std::vector<std::size_t> trees;
  std::vector<Level> levels;
  int begin{0}, end{0};         ///< its slots, multiples of ROW
  std::vector<BaseRows> bases;  ///< bases of the first level's joints
  bool bars{true};              ///< only round bars
  bool on_axis{true};           ///< air grips the axes of bars
  bool calm{true};              ///< all trees at theta = 1/2
  float fastest{0.f};           ///< largest rate after the last step [rad/s]
  bool stepped{false};          ///< `fastest` is that of the present state

  int workRows() const { return bars && on_axis ? W_BAR_ROWS : W_ROWS; }
};

/// Rows of one level, one array per quantity, with room for a vector that runs over the end.
struct LevelRows {
  int room{0};  ///< floats from one quantity to the next
  Rows rows;

  /// The number of lines is odd, so that the arrays do not fall on the same lines of the cache.
  void fit(int joints, int quantities) {
    const int lines = ((joints + ROW - 1) / ROW + 1) | 1;
    room = lines * ROW;
    rows.grow(static_cast<std::size_t>(lines) * static_cast<std::size_t>(quantities));
  }
  float* data() { return rows.at(0); }
  const float* data() const { return rows.at(0); }
};

/// Scratch memory of steps: of one group, of one of its levels and of the next level. Chains that
/// step one after the other may share it. What an earlier step left there affects no result as long
/// as it is finite.
struct ChainScratch {
  Rows work, kept, motion, places;
  LevelRows first, second;

  /// Makes room for groups of up to `blocks` blocks of joints with up to `widest` joints a level.
  void fit(std::size_t blocks, int widest) {
    work.grow(blocks * W_ROWS);
    kept.grow(blocks * K_ROWS);
    motion.grow(blocks * M_ROWS);
    places.grow(blocks * V_ROWS);
    first.fit(widest, P_ROWS);
    second.fit(widest, P_ROWS);
  }
  void clear() { *this = ChainScratch(); }
  std::size_t bytes() const {
    return work.bytes() + kept.bytes() + motion.bytes() + places.bytes() + first.rows.bytes() +
           second.rows.bytes();
  }
};

/// All rows of a chain.
struct ChainStore {
  Rows constants, state;
  int constant_rows{C_ROWS};
  Rows loads;                      ///< empty: no loads
  Rows grips, air;                 ///< empty: no air
  Rows beside;                     ///< empty: air acts on axes only
  ChainScratch* scratch{nullptr};  ///< of this step
  bool trace{false};               ///< the motion is needed
  bool asked{false};               ///< this step asks for the wind
  bool averages{true};             ///< velocity products are those of a mean over the step
  bool mean{true};                 ///< velocity products are averaged in this step
  bool predicted{false};  ///< or taken at the rates that the step before predicts for its middle
  bool drag{false};       ///< some loads have drag
  std::vector<AnchorRows> anchors;  ///< sorted by slot
};

/// Computes geometry and rigid bodies of a group at q + theta h rate, h = `step`, and the positions
/// of the grips where the step asks for the wind.
void sweepOut(const ChainGroup& group, float step, ChainStore& store);
/// Computes articulated inertias and accelerations, and steps the group. Returns the largest rate
/// after it.
float sweepBack(const ChainGroup& group, float step, ChainStore& store);

}  // namespace vegetation_sim::physics

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/simd/chain_fill.h"
#include "dynamics/simd/chain_levels.h"
#include "dynamics/simd/chain_rows.h"

namespace vegetation_sim::physics {

/// Trees that step together, small enough for the second-level cache unless one is larger.
struct ChainGroup {
  std::vector<std::size_t> trees;
  std::vector<Level> levels;
  int begin{0}, end{0};         ///< its slots, multiples of ROW
  std::vector<BaseRows> bases;  ///< of the first level's joints
  bool bars{true};              ///< nothing but round bars
  bool on_axis{true};           ///< air grips the axes of bars
  bool calm{true};              ///< all trees at theta = 1/2
  float fastest{0.f};           ///< rate of all [rad/s]

  int workRows() const { return bars && on_axis ? W_BAR_ROWS : W_ROWS; }
};

/// Rows of one level, one array per quantity, with room for a vector that runs over the end.
struct LevelRows {
  int room{0};  ///< floats from one quantity to the next
  Rows rows;

  /// An odd number of lines, so that the arrays do not fall on the same lines of the cache.
  void fit(int joints, int quantities) {
    const int lines = ((joints + ROW - 1) / ROW + 1) | 1;
    room = lines * ROW;
    rows.assign(static_cast<std::size_t>(lines) * static_cast<std::size_t>(quantities));
  }
  float* data() { return rows.at(0); }
  const float* data() const { return rows.at(0); }
};

/// All rows of a chain, and scratch: of one group, of one of its levels and that one's neighbour.
struct ChainStore {
  Rows constants, state;
  int constant_rows{C_ROWS};
  Rows loads;             ///< none: nothing acts
  Rows grips, air;        ///< none: no air
  Rows beside;            ///< none: air grips but axes
  Rows work, kept;        ///< scratch of a group
  Rows motion, places;    ///< likewise
  bool trace{false};      ///< somebody asks for the motion
  bool asked{false};      ///< the air is asked for in this step
  bool averages{true};    ///< velocity products are those of a mean over the step
  bool mean{true};        ///< and are averaged in this step
  bool predicted{false};  ///< or taken at the rates that the step before foretells for its middle
  bool drag{false};       ///< some load has drag
  LevelRows first, second;
  std::vector<AnchorRows> anchors;  ///< sorted by slot
};

/// Geometry and rigid bodies of a group at q + theta h rate, h = `step`; places of the grips where
/// the air is asked for.
void sweepOut(const ChainGroup& group, float step, ChainStore& store);
/// Articulated inertias, accelerations, and the step. Returns the largest rate after it.
float sweepBack(const ChainGroup& group, float step, ChainStore& store);

}  // namespace vegetation_sim::physics

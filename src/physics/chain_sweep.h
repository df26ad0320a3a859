// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "physics/chain_fill.h"
#include "physics/chain_parts.h"
#include "physics/chain_rows.h"

namespace vegetation_sim::physics {

/// Trees that step together, small enough for the second-level cache, or one larger tree in parts.
struct ChainGroup {
  std::vector<std::size_t> trees;
  std::vector<ChainPart> parts;
  std::vector<JointRows> hung;  ///< what passes between the first part and the others' roots
  int begin{0}, end{0};         ///< its slots, multiples of ROW
  std::vector<BaseRows> bases;  ///< of the joints of the first part's first level
  bool bars{true};              ///< nothing but round bars
  bool on_axis{true};           ///< air grips the axes of bars
  bool calm{true};              ///< all trees at theta = 1/2
  bool backwards{false};        ///< the next step goes through the parts from the last
  float fastest{0.f};           ///< rate of all [rad/s]

  /// The part that comes after `i` others; the first always does first.
  std::size_t partAt(int i) const {
    const std::size_t n = parts.size(), place = static_cast<std::size_t>(i);
    return backwards && i > 0 ? n - place : place;
  }
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

/// All rows of a chain, and scratch: of one group, of one level of a part and that one's neighbour.
struct ChainStore {
  Rows constants, state;
  Rows loads;         ///< none: nothing acts
  Rows grips, air;    ///< none: no air
  Rows work, motion;  ///< scratch of a group
  bool trace{false};  ///< somebody asks for the motion
  bool asked{false};  ///< the air is asked for in this step
  bool mean{true};    ///< velocity products are averaged over the step
  bool drag{false};   ///< some load has drag
  LevelRows first, second;
  std::vector<JointRows> anchors;  ///< sorted by slot
};

// One sweep over a part of a group. What sweeps to the twigs comes to the first part first, what
// sweeps to the roots comes to it last.

/// Geometry and rigid bodies at q + theta h rate, h = `step`.
void sweepOut(ChainGroup& group, std::size_t part, float step, ChainStore& store);
/// Places of the grips where sweepOut left the links.
void placeGrips(const ChainGroup& group, std::size_t part, ChainStore& store);
/// Articulated inertias and bias wrenches, back to the roots.
void sweepIn(ChainGroup& group, std::size_t part, float step, ChainStore& store);
/// Accelerations, and what they change in the links' bias wrenches after the step.
void sweepAhead(ChainGroup& group, std::size_t part, float step, ChainStore& store);
/// That change, back to the roots.
void sweepWrenches(ChainGroup& group, std::size_t part, ChainStore& store);
/// The step. Returns the largest rate after it.
float sweepSettle(ChainGroup& group, std::size_t part, float step, ChainStore& store);

}  // namespace vegetation_sim::physics

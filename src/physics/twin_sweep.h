// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "physics/chain_fill.h"
#include "physics/chain_rows.h"

namespace vegetation_sim::physics {

/// A joint of the topology that all trees share, in depth-first order: whoever is handed a value
/// waits on a stack as deep as the tree, which stays in the first-level cache.
struct TwinJoint {
  int depth{0};
  int root{-1};      ///< number of a root, -1: no root
  bool leaf{false};  ///< bears nobody
  bool last{false};  ///< child of its parent
  bool bar{false};   ///< in all trees a round bar
};

/// One tree a lane, ROW trees a pack. Rows: [pack][joint], bases: [pack][root].
struct TwinStore {
  std::vector<TwinJoint> joints;
  int roots{0};
  Rows constants, state, loads, bases;
  Rows work, kept, motion;          ///< of one pack
  Rows stack;                       ///< P_ROWS a depth
  bool trace{false};                ///< somebody asks for the motion
  bool mean{true};                  ///< velocity products are averaged over the step
  bool drag{false};                 ///< some load has drag
  std::vector<AnchorRows> anchors;  ///< of one pack; slot: joint * ROW + lane, sorted
  float fastest[ROW] = {};          ///< [lanes] rates after the last step of a pack [rad/s]
};

/// Geometry and rigid bodies of a pack at q + theta h rate, h = `step`.
void sweepPackOut(int pack, float step, TwinStore& store);
/// Articulated inertias, accelerations, and the step; leaves the rates in `fastest`.
void sweepPackBack(int pack, float step, TwinStore& store);

}  // namespace vegetation_sim::physics

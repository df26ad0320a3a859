// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/tier_allocation.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim::forest {

/// The tier above the modal level: more modes. Not a level of motion of its own.
constexpr int FINE_MODAL_TIER = MODAL_LEVEL + 1;
/// TreeModels of a tree: its levels, the modal one, and that with fine modes on top.
constexpr std::size_t TIERS = FINE_MODAL_TIER + 1;
static_assert(TIERS <= MAX_TIERS);

/// What a forest may cost, and what things cost, on the machine that draws it: data, not a clock,
/// so that every process chooses alike.
struct Budget {
  double frame_time{8.0};        ///< of trees that move, a frame [ms]
  int state_bytes{100000};       ///< of amplitudes in key frames, a second [B]
  int modal_trees{64};           ///< in modes at once
  double tree_cost{4000.0};      ///< a tree that moves, and frame, however few branches [ns]
  double procedural_cost{15.0};  ///< a branch and frame, forward kinematics included [ns]
  double modal_cost{20.0};  ///< the same, with its share of finding the modes once in 10 s [ns]
  double fine_cost{90.0};   ///< of fine modes, found once in 15 s [ns]
  double physical_cost{2200.0};  ///< a physical branch and frame [ns]
};
void describe(FieldVisitor& visitor, Budget& budget);

/// A tree that somebody sees move: `id` is the tree, errors are in pixels, costs in ms a frame;
/// procedural tiers are its stair, modes are wanted above it.
using Plant = TierChoice;

/// What was chosen, and why.
struct GovernorFigures : TierAllocation {
  double physical{0.0};     ///< of the cost, physical branches [ms]
  double budget{0.0};       ///< [ms]
  std::size_t strained{0};  ///< trees that bend too far for modes
};

/// Leaves modes to the plants whose procedural motion is farthest off, at most `trees` of them and
/// as many as `bytes` a second can tell of; the others want the top of their stair. Fine modes come
/// out of the bytes that are left when all have plain ones.
void shareModes(std::vector<Plant>& plants, int trees, int bytes);

}  // namespace vegetation_sim::forest

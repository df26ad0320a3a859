// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/tier_allocation.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim::forest {

/// The tier above the modal level, with more modes. It is not a level of motion.
constexpr int FINE_MODAL_TIER = MODAL_LEVEL + 1;
/// Number of tiers: levels, modal level, fine modes.
constexpr std::size_t TIERS = FINE_MODAL_TIER + 1;
static_assert(TIERS <= MAX_TIERS);

/// Allowed cost of a forest and the costs of its parts on the displaying machine. These are
/// parameters instead of measured times, so that every process chooses the same tiers.
struct Budget {
  double frame_time{8.0};        ///< of moving trees per frame [ms]
  int state_bytes{100000};       ///< of amplitudes in key frames per second [B]
  int modal_trees{64};           ///< maximum number of modal trees
  double tree_cost{4000.0};      ///< per moving tree and frame, without its branches [ns]
  double procedural_cost{15.0};  ///< per branch and frame, forward kinematics included [ns]
  double modal_cost{20.0};       ///< the same for modes, computed once in 10 s [ns]
  double fine_cost{90.0};        ///< the same for fine modes, computed once in 15 s [ns]
  double physical_cost{2200.0};  ///< per physical branch and frame [ns]
};
void describe(FieldVisitor& visitor, Budget& budget);

/// A visibly moving tree: `id` is the tree, errors are in pixels, costs in ms per frame. Procedural
/// levels are the stepwise tiers; modes are above them.
using Plant = TierChoice;

/// Result of the tier allocation.
struct GovernorFigures : TierAllocation {
  double physical{0.0};     ///< part of the cost, of physical branches [ms]
  double budget{0.0};       ///< [ms]
  std::size_t strained{0};  ///< trees that bend too far for modes
};

/// Assigns modes to the trees whose procedural motion has the largest errors: at most `trees` of
/// them, within `bytes` per second. The others get their highest level. Fine modes use the bytes
/// that remain when all have plain ones.
void shareModes(std::vector<Plant>& plants, int trees, int bytes);

}  // namespace vegetation_sim::forest

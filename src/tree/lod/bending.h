// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/modes/harmonic_chain.h"
#include "tree/lod/response_error.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {

/// Returns the procedural angles with all depths moving.
std::vector<JointAngles> allDepths(const Tree& tree, const wind::Instant& air);

/// One tree in each of its models.
struct TreeModels {
  const Tree& tree;
  const std::vector<physics::Link>& links;
  const std::vector<physics::Grip>& grips;
  const physics::LinearChain& linear;
  const ModalTree& modal;
};

/// Returns the largest distance of tips from where a steady wind along a unit vector holds the full
/// chain.
Bending bendingOf(const TreeModels& tiers, const Vec3& along);

}  // namespace vegetation_sim::forest

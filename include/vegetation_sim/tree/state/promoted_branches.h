// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/tree/modal/modal_tree_state.h"

namespace vegetation_sim::forest {

/// Stamp of what has not happened.
constexpr Nanoseconds NEVER = -1;

/// A physical joint as others need to know it (S1-34: four numbers).
struct PromotedBranch {
  int branch{0};
  JointAngles q;             ///< bends about the own rest x and y [rad]
  JointAngles rate;          ///< [rad/s]
  Nanoseconds blend{NEVER};  ///< start of its blend back to the procedural motion
};

/// Physical joints of one tree at a stamp, by rising branch.
struct PromotedTree {
  Nanoseconds stamp{0};
  double duration{1.5};  ///< of blends [s]
  std::vector<PromotedBranch> branches;
};

/// Weight of the procedural motion, 0 to 1: smoothStep of the blend's progress (S1-37).
double blendWeight(const PromotedBranch& branch, Nanoseconds stamp, double duration);

/// Puts promoted joints over procedural ones: at the promoted tree's stamp exactly, up to
/// LONGEST_LOOK_AHEAD later by their rates.
void overlay(const PromotedTree& promoted, Nanoseconds stamp, std::vector<JointAngles>& angles);

/// Pose of every branch in the tree's frame, physical ones and modes included (S1-35, N13).
/// `modal_state`: none, the tree has no modes.
std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                               const ModalTreeState* modal_state, const PromotedTree& promoted,
                               Nanoseconds stamp);

}  // namespace vegetation_sim::forest

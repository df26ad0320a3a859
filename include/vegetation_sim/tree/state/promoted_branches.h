// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "vegetation_sim/tree/modal/modal_tree_state.h"

namespace vegetation_sim::forest {

/// Stamp of an event that has not happened.
constexpr Nanoseconds NEVER = -1;

/// State of a physical joint for replicas (S1-34: four numbers).
struct PromotedBranch {
  int branch{0};
  JointAngles q;             ///< bends about the own rest x and y [rad]
  JointAngles rate;          ///< [rad/s]
  Nanoseconds blend{NEVER};  ///< start of its blend back to the procedural motion
};

/// Physical joints of one tree at a stamp, sorted by branch.
struct PromotedTree {
  Nanoseconds stamp{0};
  double duration{1.5};  ///< of blends [s]
  std::vector<PromotedBranch> branches;
};

/// Returns the weight of the procedural motion, 0 to 1: smoothStep of the progress of the blend
/// (S1-37).
double blendWeight(const PromotedBranch& branch, Nanoseconds stamp, double duration);

/// Replaces procedural angles by promoted ones: exact at the stamp of `promoted`, extrapolated by
/// rates over at most LONGEST_LOOK_AHEAD.
void overlay(const PromotedTree& promoted, Nanoseconds stamp, std::vector<JointAngles>& angles);

/// Returns the pose of every branch in the tree's frame, physical joints and modes included (S1-35,
/// N13). `modal_state` is null for a tree without modes.
std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                               const ModalTreeState* modal_state, const PromotedTree& promoted,
                               Nanoseconds stamp);

/// Poses of those branches of a tree whose parents have been entered.
struct ReachedPoses {
  std::vector<Pose> poses;    ///< [branches], identity where not posed
  std::vector<char> entered;  ///< [branches] 1: what the branch bears is posed
};
/// Returns the same poses from the foot up, without what grows on a branch that `enters` rejects.
ReachedPoses poseReached(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                         const ModalTreeState* modal_state, const PromotedTree& promoted,
                         Nanoseconds stamp,
                         const std::function<bool(int branch, const Pose&)>& enters);

}  // namespace vegetation_sim::forest

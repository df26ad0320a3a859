// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/state/promoted_branches.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {

double blendWeight(const PromotedBranch& branch, Nanoseconds stamp, double duration) {
  if (branch.blend == NEVER) return 0.0;
  if (duration <= 0.0) return 1.0;
  return smoothStep(secondsBetween(branch.blend, stamp) / duration);
}

void overlay(const PromotedTree& promoted, Nanoseconds stamp, std::vector<JointAngles>& angles) {
  const double ahead =
      std::clamp(secondsBetween(promoted.stamp, stamp), -LONGEST_LOOK_AHEAD, LONGEST_LOOK_AHEAD);
  for (const PromotedBranch& branch : promoted.branches) {
    const double weight = blendWeight(branch, stamp, promoted.duration);
    JointAngles& angle = angles[static_cast<std::size_t>(branch.branch)];
    const double first = branch.q.first + ahead * branch.rate.first;
    const double second = branch.q.second + ahead * branch.rate.second;
    angle.first = (1.0 - weight) * first + weight * angle.first;
    angle.second = (1.0 - weight) * second + weight * angle.second;
  }
}

std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                               const ModalTreeState* modal_state, const PromotedTree& promoted,
                               Nanoseconds stamp) {
  std::vector<JointAngles> angles = modalAngles(tree, wind, weights, modal_state, stamp);
  overlay(promoted, stamp, angles);
  return forwardKinematics(tree, angles);
}

}  // namespace vegetation_sim::forest

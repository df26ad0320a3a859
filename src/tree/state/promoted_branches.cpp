// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/state/promoted_branches.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

void overlay(const PromotedTree& promoted, const PromotedBranch& branch, Nanoseconds stamp,
             JointAngles& angle) {
  const double ahead =
      std::clamp(secondsBetween(promoted.stamp, stamp), -LONGEST_LOOK_AHEAD, LONGEST_LOOK_AHEAD);
  const double weight = blendWeight(branch, stamp, promoted.duration);
  const double first = branch.q.first + ahead * branch.rate.first;
  const double second = branch.q.second + ahead * branch.rate.second;
  angle.first = (1.0 - weight) * first + weight * angle.first;
  angle.second = (1.0 - weight) * second + weight * angle.second;
}

}  // namespace

double blendWeight(const PromotedBranch& branch, Nanoseconds stamp, double duration) {
  if (branch.blend == NEVER) return 0.0;
  if (duration <= 0.0) return 1.0;
  return smoothStep(secondsBetween(branch.blend, stamp) / duration);
}

void overlay(const PromotedTree& promoted, Nanoseconds stamp, std::vector<JointAngles>& angles) {
  for (const PromotedBranch& branch : promoted.branches)
    overlay(promoted, branch, stamp, angles[static_cast<std::size_t>(branch.branch)]);
}

std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                               const ModalTreeState* modal_state, const PromotedTree& promoted,
                               Nanoseconds stamp) {
  std::vector<JointAngles> angles = modalAngles(tree, wind, weights, modal_state, stamp);
  overlay(promoted, stamp, angles);
  return forwardKinematics(tree, angles);
}

ReachedPoses poseReached(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                         const ModalTreeState* modal_state, const PromotedTree& promoted,
                         Nanoseconds stamp,
                         const std::function<bool(int branch, const Pose&)>& enters) {
  const std::size_t count = tree.skeleton.branches.size();
  std::vector<JointAngles> modal;
  if (modal_state) modal = modalAngles(tree, wind, weights, modal_state, stamp);
  ReachedPoses out{std::vector<Pose>(count), std::vector<char>(count, 0)};
  auto physical = promoted.branches.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const int branch = static_cast<int>(i), parent = tree.skeleton.branches[i].parent;
    while (physical != promoted.branches.end() && physical->branch < branch) ++physical;
    const auto bearer = static_cast<std::size_t>(std::max(parent, 0));
    if (parent >= 0 && !out.entered[bearer]) continue;
    JointAngles angles = modal_state ? modal[i] : proceduralAngles(tree, wind, weights, branch);
    if (physical != promoted.branches.end() && physical->branch == branch)
      overlay(promoted, *physical, stamp, angles);
    out.poses[i] = poseOnParent(tree, branch, angles, out.poses[bearer]);
    out.entered[i] = enters(branch, out.poses[i]) ? 1 : 0;
  }
  return out;
}

}  // namespace vegetation_sim::forest

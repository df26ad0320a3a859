// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What comes off a skeleton.
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {
namespace {

constexpr double SHRUNK = 1e-3;  // size of what is gone over its size before

bool canComeOff(const Skeleton& skeleton, int branch) {
  return branch > 0 && branch < static_cast<int>(skeleton.branches.size());
}

}  // namespace

bool operator==(const BrokenBranch& a, const BrokenBranch& b) {
  const Quat &p = a.pose.orientation, &q = b.pose.orientation;
  return a.branch == b.branch && a.stamp == b.stamp && a.cut == b.cut &&
         a.pose.position == b.pose.position && p.w == q.w && p.x == q.x && p.y == q.y &&
         p.z == q.z && a.velocity == b.velocity && a.spin == b.spin;
}

const BrokenBranches& brokenOf(const BrokenTrees& trees, std::uint32_t tree) {
  static const BrokenBranches NONE;
  const auto found = trees.find(tree);
  return found == trees.end() ? NONE : found->second;
}

void breakOff(const BrokenBranches& broken, Skeleton& skeleton) {
  if (broken.empty()) return;
  std::vector<Branch>& branches = skeleton.branches;
  for (const BrokenBranch& piece : broken) {
    if (!canComeOff(skeleton, piece.branch))
      throw InvalidInput("broken branch = " + std::to_string(piece.branch) + " is outside 1 to " +
                             std::to_string(branches.size() - 1),
                         FaultCode::UNKNOWN);
    branches[static_cast<std::size_t>(piece.branch)].broken = true;
  }
  for (std::size_t i = 1; i < branches.size(); ++i) {
    Branch& branch = branches[i];
    if (branch.parent < 0) continue;
    Branch& parent = branches[static_cast<std::size_t>(branch.parent)];
    branch.broken = branch.broken || parent.broken;
    if (!branch.broken) continue;
    if (parent.broken) branch.h *= SHRUNK;
    if (!parent.broken && parent.next == static_cast<int>(i)) parent.next = -1;
    branch.length *= SHRUNK;
    branch.base_radius *= SHRUNK;
    branch.tip_radius *= SHRUNK;
    branch.leaves = 0;
    branch.rest.position = parent.rest.position + branch.h * axisZ(parent.rest.orientation);
  }
}

void keepPiece(int branch, Skeleton& skeleton) {
  std::vector<Branch>& branches = skeleton.branches;
  if (!canComeOff(skeleton, branch))
    throw InvalidInput("broken branch = " + std::to_string(branch) + " is outside 1 to " +
                           std::to_string(branches.size() - 1),
                       FaultCode::UNKNOWN);
  std::vector<char> kept(branches.size(), 0);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    Branch& own = branches[i];
    const bool carried = own.parent >= 0 && kept[static_cast<std::size_t>(own.parent)];
    kept[i] = static_cast<int>(i) == branch || carried;
    if (kept[i] && !carried && own.parent >= 0) {
      Branch& parent = branches[static_cast<std::size_t>(own.parent)];
      if (parent.next == branch) parent.next = -1;
    }
    if (kept[i]) continue;
    own.broken = true;
    own.leaves = 0;
  }
}

}  // namespace vegetation_sim::forest

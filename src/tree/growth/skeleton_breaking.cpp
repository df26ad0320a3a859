// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Removal of branches from a skeleton.
#include <algorithm>
#include <utility>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {
namespace {

constexpr double SHRUNK = 1e-3;  // size of what is gone over its size before

[[noreturn]] void rejectBranch(int branch, std::size_t branches) {
  throw InvalidInput("broken branch = " + std::to_string(branch) + " is outside 1 to " +
                         std::to_string(static_cast<long>(branches) - 1),
                     FaultCode::UNKNOWN);
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
    if (piece.branch < 1 || piece.branch >= static_cast<int>(branches.size()))
      rejectBranch(piece.branch, branches.size());
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

std::vector<int> keepPiece(int branch, Skeleton& skeleton) {
  const std::vector<Branch> all = std::exchange(skeleton.branches, {});
  if (branch < 1 || branch >= static_cast<int>(all.size())) rejectBranch(branch, all.size());
  std::vector<int> kept;
  std::vector<int> places(all.size(), -1);  // in `kept`
  for (std::size_t i = static_cast<std::size_t>(branch); i < all.size(); ++i) {
    const bool is_root = static_cast<int>(i) == branch;
    const int parent = all[i].parent;
    const int below = parent < 0 || is_root ? -1 : places[static_cast<std::size_t>(parent)];
    if (!is_root && (below < 0 || all[i].broken)) continue;
    places[i] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(i));
    skeleton.branches.push_back(all[i]);
    skeleton.branches.back().parent = below;
  }
  for (Branch& own : skeleton.branches)
    if (own.next >= 0) own.next = places[static_cast<std::size_t>(own.next)];
  const auto place_of = [&](int before) {
    return static_cast<int>(std::lower_bound(kept.begin(), kept.end(), before) - kept.begin());
  };
  for (int& end : skeleton.depth_end) end = place_of(end);
  std::vector<Group> groups;
  for (const Group& group : skeleton.groups) {
    const Group own{place_of(group.begin), place_of(group.end), group.depth};
    if (own.begin < own.end) groups.push_back(own);
  }
  skeleton.groups = std::move(groups);
  skeleton.rooted = false;
  return kept;
}

}  // namespace vegetation_sim::forest

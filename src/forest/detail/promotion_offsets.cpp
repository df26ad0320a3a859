// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/promotion_offsets.h"

#include <algorithm>

#include "core/archive/archive.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

// Returns whether a branch is physical and does not blend back.
bool holds(const PromotedTree& promoted, int branch) {
  const auto found = std::lower_bound(
      promoted.branches.begin(), promoted.branches.end(), branch,
      [](const PromotedBranch& entry, int wanted) { return entry.branch < wanted; });
  return found != promoted.branches.end() && found->branch == branch && found->blend == NEVER;
}

}  // namespace

void PromotionOffsets::update(std::uint32_t tree, const PromotedTree& before,
                              const PromotedTree& now,
                              const std::function<std::vector<JointAngles>()>& differences) {
  std::vector<JointAngles> all;
  for (const PromotedBranch& branch : now.branches) {
    if (branch.blend != NEVER || holds(before, branch.branch)) continue;
    if (all.empty()) all = differences();
    const JointAngles& angles = all[static_cast<std::size_t>(branch.branch)];
    if (angles.first != 0.0 || angles.second != 0.0)
      offsets_[tree][branch.branch] = {now.stamp, angles};
  }
}

void PromotionOffsets::prune(Nanoseconds stamp, double duration) {
  for (auto tree = offsets_.begin(); tree != offsets_.end();) {
    auto& branches = tree->second;
    for (auto it = branches.begin(); it != branches.end();)
      it = secondsBetween(it->second.since, stamp) < duration ? std::next(it) : branches.erase(it);
    tree = branches.empty() ? offsets_.erase(tree) : std::next(tree);
  }
}

// The rate is that of smoothStep(), so that listeners extrapolate between ticks without a jump.
void PromotionOffsets::addTo(std::uint32_t tree, double duration, PromotedTree& promoted) const {
  const auto found = offsets_.find(tree);
  if (found == offsets_.end()) return;
  for (PromotedBranch& branch : promoted.branches) {
    const auto offset = found->second.find(branch.branch);
    if (offset == found->second.end()) continue;
    const double at = saturate(secondsBetween(offset->second.since, promoted.stamp) / duration);
    const double left = 1.0 - smoothStep(at), rate = -6.0 * at * (1.0 - at) / duration;
    branch.q.first += left * offset->second.angles.first;
    branch.q.second += left * offset->second.angles.second;
    branch.rate.first += rate * offset->second.angles.first;
    branch.rate.second += rate * offset->second.angles.second;
  }
}

void PromotionOffsets::archive(Archive& a, std::size_t trees) {
  constexpr std::size_t OFFSET_BYTES = 28;
  a.map(
      "offsets", offsets_, trees, sizeof(std::uint32_t) * 2,
      [&](std::uint32_t& tree) {
        a.integer<std::uint32_t>("tree", tree, 0, static_cast<std::uint32_t>(trees) - 1);
      },
      [&](std::uint32_t, std::map<int, Offset>& branches) {
        a.map(
            "offsets of a tree", branches, MAX_BRANCHES, OFFSET_BYTES,
            [&a](int& branch) { a.integer("branch", branch, 0, MAX_BRANCHES - 1); },
            [&a](int, Offset& offset) {
              a.stamp("offset since", offset.since);
              a.number("offset", offset.angles.first);
              a.number("offset", offset.angles.second);
            });
      });
}

}  // namespace vegetation_sim::forest

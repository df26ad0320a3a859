// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/common/governor.h"
#include "vegetation_sim/forest/forest.h"
#include "vegetation_sim/forest/tree_cache.h"

namespace vegetation_sim {

/// Which branches are sent as tf frames tree_<id>/branch_<id>, never more than a budget.
class BranchFrames {
 public:
  explicit BranchFrames(int budget) : budget_(static_cast<std::size_t>(budget)) {}

  /// Adds or removes branches of a tree; empty: all of its `count`. A request that would pass the
  /// budget, or that names an unknown branch, changes nothing. @throws InvalidInput
  void set(std::uint32_t tree, std::vector<std::uint32_t> branches, std::size_t count, bool enable);
  void clear() { *this = BranchFrames(static_cast<int>(budget_)); }
  std::size_t count() const;
  std::size_t budget() const { return budget_; }
  bool empty() const { return wanted_.empty(); }
  /// Branches that are sent, by tree, in order.
  using Wanted = std::map<std::uint32_t, std::vector<std::uint32_t>>;
  const Wanted& wanted() const { return wanted_; }
  /// And the branches that are held, then the physical ones whose tips are farthest from where they
  /// rest, as far as the budget goes (N7): without a frame a listener has them there.
  Wanted withPhysical(const forest::Forest& forest, forest::TreeCache& cache,
                      const std::vector<forest::BranchPoint>& held, Nanoseconds stamp);
  /// What was chosen then: costs are frames, errors metres.
  const Balance& balance() const { return balance_; }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // tree, branch
  struct Offered;
  Offered offer(const forest::Forest& forest, forest::TreeCache& cache,
                const std::vector<forest::BranchPoint>& held, Nanoseconds stamp) const;
  std::size_t room() const { return budget_ - count(); }
  bool isWanted(const Key& key) const;

  std::size_t budget_;
  Wanted wanted_;
  std::map<Key, Nanoseconds> sent_;  // without the wanted ones; since when
  Nanoseconds stamp_{0};             // of the last choice
  Balance balance_;
};

/// Poses of a tree at a stamp, tree's frame, by the double path.
std::vector<Pose> posesOf(const forest::Forest& forest, const forest::Tree& tree, std::uint32_t id,
                          Nanoseconds stamp);

/// Transforms of every wanted branch at `stamp`, all to be sent at once.
std::vector<geometry_msgs::TransformStamped> branchTransforms(const BranchFrames::Wanted& wanted,
                                                              const forest::Forest& forest,
                                                              forest::TreeCache& cache,
                                                              const std::string& frame_id,
                                                              Nanoseconds stamp);

}  // namespace vegetation_sim

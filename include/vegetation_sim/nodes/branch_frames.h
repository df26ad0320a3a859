// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

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
  void clear() { wanted_.clear(); }
  std::size_t count() const;
  std::size_t budget() const { return budget_; }
  bool empty() const { return wanted_.empty(); }
  /// Branches that are sent, by tree, in order.
  using Wanted = std::map<std::uint32_t, std::vector<std::uint32_t>>;
  const Wanted& wanted() const { return wanted_; }
  /// And the branches that are held, then all that are physical, as far as the budget goes.
  Wanted withPhysical(const forest::Forest& forest,
                      const std::vector<forest::BranchPoint>& held) const;

 private:
  std::size_t budget_;
  Wanted wanted_;
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

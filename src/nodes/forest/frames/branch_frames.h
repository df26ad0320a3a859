// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/lod/tier_allocation.h"
#include "forest/forest.h"
#include "forest/tree_cache.h"

namespace vegetation_sim {

/// Trees at a stamp; each is posed once, by the double path.
class PosedTrees {
 public:
  PosedTrees(const forest::Forest& forest, forest::TreeCache& cache, Nanoseconds stamp)
      : forest_(forest), cache_(cache), stamp_(stamp) {}

  struct Posed {
    std::shared_ptr<const forest::TreeCache::Grown> grown;
    std::vector<Pose> poses;  ///< tree's frame
  };
  const Posed& of(std::uint32_t tree);
  const forest::Forest& forest() const { return forest_; }
  Nanoseconds stamp() const { return stamp_; }

 private:
  const forest::Forest& forest_;
  forest::TreeCache& cache_;
  Nanoseconds stamp_;
  std::map<std::uint32_t, Posed> posed_;
};

/// Which branches are sent as tf frames tree_<id>/branch_<id>, never more than a budget.
class BranchFrames {
 public:
  explicit BranchFrames(int budget) : budget_(static_cast<std::size_t>(budget)) {}

  /// Adds or removes branches of a tree that has `count`. A request that would pass the budget, or
  /// that names no branch or an unknown one, changes nothing. @throws InvalidInput
  void set(std::uint32_t tree, const std::vector<std::uint32_t>& branches, std::size_t count,
           bool enable);
  void clear() { *this = BranchFrames(static_cast<int>(budget_)); }
  std::size_t count() const;
  std::size_t budget() const { return budget_; }
  bool empty() const { return wanted_.empty(); }
  /// Branches that are sent, by tree, in order.
  using Wanted = std::map<std::uint32_t, std::vector<std::uint32_t>>;
  const Wanted& wanted() const { return wanted_; }
  /// And the branches that are held, then the physical ones whose tips are farthest from where they
  /// rest, as far as the budget goes (N7): without a frame a listener has them there.
  Wanted withPhysical(PosedTrees& trees, const std::vector<forest::BranchPoint>& held);
  /// Returns the last choice of withPhysical(): costs are frames, errors metres. The largest error
  /// is not a number where wanted and held branches leave no room, since it is not computed then.
  const TierAllocation& balance() const { return balance_; }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // tree, branch
  static Key keyOf(std::uint32_t tree, int branch) {
    return {tree, static_cast<std::uint32_t>(branch)};
  }
  std::vector<Key> choose(const std::vector<Key>& keys, PosedTrees& trees, std::size_t room);
  std::vector<TierChoice> choicesOf(const std::vector<Key>& keys, PosedTrees& trees,
                                    std::size_t room) const;

  std::size_t budget_;
  Wanted wanted_;
  std::map<Key, Nanoseconds> sent_;  // since when
  Nanoseconds stamp_{0};             // of the last choice
  TierAllocation balance_;
};

/// Poses of a tree at a stamp as sensors perceive it, tree's frame, by the double path.
std::vector<Pose> posesOf(const forest::Forest& forest, const forest::Tree& tree, std::uint32_t id,
                          Nanoseconds stamp);

/// Transforms of every wanted branch, all to be sent at once. `prefix` precedes their names.
std::vector<geometry_msgs::TransformStamped> branchTransforms(const BranchFrames::Wanted& wanted,
                                                              PosedTrees& trees,
                                                              const std::string& frame_id,
                                                              const std::string& prefix);

}  // namespace vegetation_sim

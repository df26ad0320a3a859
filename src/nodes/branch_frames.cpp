// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/branch_frames.h"

#include <algorithm>
#include <set>

#include "vegetation_sim/ros/forest_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double IN_HAND = 1e6;  // what a frame of a held branch counts: before all others [m]

}  // namespace

void BranchFrames::set(std::uint32_t tree, std::vector<std::uint32_t> branches, std::size_t count,
                       bool enable) {
  if (branches.empty())
    for (std::uint32_t i = 0; i < count; ++i) branches.push_back(i);
  for (const std::uint32_t branch : branches)
    if (branch >= count)
      throw InvalidInput("branch = " + std::to_string(branch) + " is unknown; tree " +
                         std::to_string(tree) + " has " + std::to_string(count) + ", from 0");
  const auto found = wanted_.find(tree);
  std::set<std::uint32_t> wanted;
  if (found != wanted_.end()) wanted.insert(found->second.begin(), found->second.end());
  const std::size_t before = wanted.size();
  for (const std::uint32_t branch : branches)
    enable ? (void)wanted.insert(branch) : (void)wanted.erase(branch);
  const std::size_t after = this->count() - before + wanted.size();
  if (after > budget_)
    throw InvalidInput("frames = " + std::to_string(after) + " would pass the budget of " +
                       std::to_string(budget_));
  if (wanted.empty())
    wanted_.erase(tree);
  else
    wanted_[tree].assign(wanted.begin(), wanted.end());
}

std::size_t BranchFrames::count() const {
  std::size_t out = 0;
  for (const auto& entry : wanted_) out += entry.second.size();
  return out;
}

bool BranchFrames::isWanted(const Key& key) const {
  const auto found = wanted_.find(key.first);
  return found != wanted_.end() &&
         std::binary_search(found->second.begin(), found->second.end(), key.second);
}

/// Branches that may have a frame, and what lacks without.
struct BranchFrames::Offered {
  std::vector<Key> keys;
  std::vector<Choice> choices;
};

BranchFrames::Offered BranchFrames::offer(const forest::Forest& forest, forest::TreeCache& cache,
                                          const std::vector<forest::BranchPoint>& held,
                                          Nanoseconds stamp) const {
  Offered out;
  const bool fits = sent_.size() <= room();  // else somebody has asked for frames meanwhile
  const auto add = [&](const Key& key, double error) {
    if (isWanted(key)) return;
    const auto known = sent_.find(key);
    Choice choice;
    choice.stair = choice.wanted = 1;
    choice.held = known != sent_.end() ? 1 : 0;
    choice.resting = fits && choice.held == 1 && secondsBetween(known->second, stamp) < RUNG_REST;
    choice.error[0] = static_cast<float>(error);
    choice.cost[1] = 1.F;
    out.keys.push_back(key);
    out.choices.push_back(choice);
  };
  std::set<Key> in_hand;
  for (const forest::BranchPoint& point : held)
    if (in_hand.insert({point.tree, static_cast<std::uint32_t>(point.branch)}).second)
      add({point.tree, static_cast<std::uint32_t>(point.branch)}, IN_HAND);
  for (const std::uint32_t tree : forest.physicalTrees()) {
    const auto grown = cache.get(forest.layout(), forest.terrain(), tree);
    const std::vector<Pose> poses = posesOf(forest, grown->tree, tree, stamp);
    for (const forest::PromotedBranch& branch : forest.promoted(tree).branches) {
      const auto index = static_cast<std::size_t>(branch.branch);
      const Key key(tree, static_cast<std::uint32_t>(branch.branch));
      if (index >= poses.size() || in_hand.count(key)) continue;
      const forest::Branch& own = grown->tree.skeleton.branches[index];
      add(key, length(tipOf(own, poses[index]) - tipOf(own, own.rest)));
    }
  }
  return out;
}

BranchFrames::Wanted BranchFrames::withPhysical(const forest::Forest& forest,
                                                forest::TreeCache& cache,
                                                const std::vector<forest::BranchPoint>& held,
                                                Nanoseconds stamp) {
  if (stamp < stamp_) sent_.clear();
  stamp_ = stamp;
  Offered offered = offer(forest, cache, held, stamp);
  balance_ = govern(offered.choices, static_cast<double>(room()), 0.0);
  std::map<Key, Nanoseconds> now;
  std::set<Key> all;
  for (const auto& [tree, branches] : wanted_)
    for (const std::uint32_t branch : branches) all.insert({tree, branch});
  for (std::size_t i = 0; i < offered.keys.size(); ++i) {
    if (offered.choices[i].chosen == 0) continue;
    const auto known = sent_.find(offered.keys[i]);
    now[offered.keys[i]] = known != sent_.end() ? known->second : stamp;
    all.insert(offered.keys[i]);
  }
  sent_ = std::move(now);
  Wanted out;
  for (const auto& [tree, branch] : all) out[tree].push_back(branch);
  return out;
}

std::vector<Pose> posesOf(const forest::Forest& forest, const forest::Tree& tree, std::uint32_t id,
                          Nanoseconds stamp) {
  return forest.pose(tree, id, stamp);
}

std::vector<geometry_msgs::TransformStamped> branchTransforms(const BranchFrames::Wanted& wanted,
                                                              const forest::Forest& forest,
                                                              forest::TreeCache& cache,
                                                              const std::string& frame_id,
                                                              Nanoseconds stamp) {
  std::vector<geometry_msgs::TransformStamped> out;
  for (const auto& [id, branches] : wanted) {
    const auto grown = cache.get(forest.layout(), forest.terrain(), id);
    const std::vector<Pose> poses = posesOf(forest, grown->tree, id, stamp);
    for (const std::uint32_t branch : branches) {
      if (branch >= poses.size()) continue;  // the designer has thinned the tree meanwhile
      const geometry_msgs::Pose pose = toMsg(grown->tree.foot, poses[branch]);
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = toStamp(stamp);
      transform.header.frame_id = frame_id;
      transform.child_frame_id = "tree_" + std::to_string(id) + "/branch_" + std::to_string(branch);
      transform.transform.translation.x = pose.position.x;
      transform.transform.translation.y = pose.position.y;
      transform.transform.translation.z = pose.position.z;
      transform.transform.rotation = pose.orientation;
      out.push_back(transform);
    }
  }
  return out;
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/frames/branch_frames.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {

const PosedTrees::Posed& PosedTrees::of(std::uint32_t tree) {
  const auto known = posed_.find(tree);
  if (known != posed_.end()) return known->second;
  const auto grown = cache_.get(forest_, tree);
  return posed_[tree] = {grown, posesOf(forest_, grown->tree, tree, stamp_)};
}

void BranchFrames::set(std::uint32_t tree, const std::vector<std::uint32_t>& branches,
                       std::size_t count, bool enable) {
  if (branches.empty())
    throw InvalidInput("branches has 0 entries; all = true stands for every branch");
  for (const std::uint32_t branch : branches)
    if (branch >= count)
      throw InvalidInput("branches: " + std::to_string(branch) + " is unknown; tree " +
                             std::to_string(tree) + " has " + std::to_string(count) + ", from 0",
                         FaultCode::UNKNOWN);
  const auto found = wanted_.find(tree);
  std::set<std::uint32_t> wanted;
  if (found != wanted_.end()) wanted.insert(found->second.begin(), found->second.end());
  const std::size_t before = wanted.size();
  for (const std::uint32_t branch : branches)
    enable ? (void)wanted.insert(branch) : (void)wanted.erase(branch);
  const std::size_t after = this->count() - before + wanted.size();
  if (after > budget_)
    throw InvalidInput("frames = " + std::to_string(after) + " would pass the budget of " +
                           std::to_string(budget_),
                       FaultCode::NO_ROOM);
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

// The error of a missing frame is computed only if not all branches can have one.
std::vector<TierChoice> BranchFrames::choicesOf(const std::vector<Key>& keys, PosedTrees& trees,
                                                std::size_t room) const {
  std::vector<TierChoice> out(keys.size());
  std::size_t resting = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    TierChoice& choice = out[i];
    const auto known = sent_.find(keys[i]);
    choice.stepwise = choice.wanted = 1;
    choice.held = known != sent_.end() ? 1 : 0;
    choice.resting = choice.held == 1 && secondsBetween(known->second, trees.stamp()) < TIER_HOLD;
    choice.cost[1] = 1.F;
    resting += choice.resting ? 1 : 0;
    if (keys.size() <= room) continue;
    const PosedTrees::Posed& tree = trees.of(keys[i].first);
    if (keys[i].second >= tree.poses.size()) continue;
    const forest::Branch& own = tree.grown->tree.skeleton.branches[keys[i].second];
    const Vec3 tip = tipOf(own, tree.poses[keys[i].second]);
    choice.error[0] = static_cast<float>(length(tip - tipOf(own, own.rest)));
  }
  if (resting > room)  // others have been asked for or taken in hand meanwhile
    for (TierChoice& choice : out) choice.resting = false;
  return out;
}

// Choices for the branches that come after those wanted and held.
std::vector<BranchFrames::Key> BranchFrames::choose(const std::vector<Key>& keys, PosedTrees& trees,
                                                    std::size_t room) {
  balance_ = TierAllocation();
  balance_.held_back = keys.size();
  balance_.largest = keys.empty() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  if (room == 0) return {};
  std::vector<TierChoice> choices = choicesOf(keys, trees, room);
  balance_ = allocateTiers(choices, static_cast<double>(room), 0.0);
  std::vector<Key> out;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (choices[i].chosen == 1) out.push_back(keys[i]);
  return out;
}

BranchFrames::Wanted BranchFrames::withPhysical(PosedTrees& trees,
                                                const std::vector<forest::BranchPoint>& held) {
  if (trees.stamp() < stamp_) sent_.clear();
  stamp_ = trees.stamp();
  std::set<Key> all, others;
  for (const auto& [tree, branches] : wanted_)
    for (const std::uint32_t branch : branches) all.insert({tree, branch});
  for (const forest::BranchPoint& point : held)
    (all.size() < budget_ ? all : others).insert(keyOf(point.tree, point.branch));
  for (const std::uint32_t tree : trees.forest().physicalTrees())
    for (const forest::PromotedBranch& branch : trees.forest().promoted(tree).branches)
      others.insert(keyOf(tree, branch.branch));
  std::vector<Key> keys;
  std::set_difference(others.begin(), others.end(), all.begin(), all.end(),
                      std::back_inserter(keys));
  for (const Key& key : choose(keys, trees, budget_ - all.size())) all.insert(key);
  std::map<Key, Nanoseconds> now;
  Wanted out;
  for (const Key& key : all) {
    const auto known = sent_.find(key);
    now[key] = known != sent_.end() ? known->second : stamp_;
    out[key.first].push_back(key.second);
  }
  sent_ = std::move(now);
  return out;
}

std::vector<Pose> posesOf(const forest::Forest& forest, const forest::Tree& tree, std::uint32_t id,
                          Nanoseconds stamp) {
  return forest.poseForSensors(tree, id, stamp);
}

std::vector<geometry_msgs::TransformStamped> branchTransforms(const BranchFrames::Wanted& wanted,
                                                              PosedTrees& trees,
                                                              const std::string& frame_id,
                                                              const std::string& prefix) {
  std::vector<geometry_msgs::TransformStamped> out;
  for (const auto& [id, branches] : wanted) {
    const PosedTrees::Posed& tree = trees.of(id);
    for (const std::uint32_t branch : branches) {
      if (branch >= tree.poses.size()) continue;  // the designer has thinned the tree meanwhile
      const geometry_msgs::Pose pose = toMsg(tree.grown->tree.foot, tree.poses[branch]);
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = toStamp(trees.stamp());
      transform.header.frame_id = frame_id;
      transform.child_frame_id =
          prefix + "tree_" + std::to_string(id) + "/branch_" + std::to_string(branch);
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

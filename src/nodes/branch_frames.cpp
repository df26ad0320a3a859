// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/branch_frames.h"

#include <algorithm>
#include <set>

#include "vegetation_sim/ros/forest_conversions.h"

namespace vegetation_sim {

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

BranchFrames::Wanted BranchFrames::withPhysical(
    const forest::Forest& forest, const std::vector<forest::BranchPoint>& held) const {
  std::map<std::uint32_t, std::set<std::uint32_t>> chosen;
  for (const auto& [tree, branches] : wanted_)
    chosen[tree].insert(branches.begin(), branches.end());
  std::size_t room = budget_ - count();
  const auto add = [&](std::uint32_t tree, int branch) {
    if (room > 0 && chosen[tree].insert(static_cast<std::uint32_t>(branch)).second) --room;
  };
  for (const forest::BranchPoint& point : held) add(point.tree, point.branch);
  for (const std::uint32_t tree : forest.physicalTrees())
    for (const forest::PromotedBranch& branch : forest.promoted(tree).branches)
      add(tree, branch.branch);
  Wanted out;
  for (const auto& [tree, branches] : chosen) out[tree].assign(branches.begin(), branches.end());
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

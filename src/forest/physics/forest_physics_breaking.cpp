// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Branches that break, and what becomes of trees that lose some.
#include <algorithm>

#include "forest/physics/forest_physics.h"
#include "forest/physics/tree_pieces.h"
#include "tree/growth/broken_branch.h"

namespace vegetation_sim::forest {
namespace {

template <class T, class Gone>
void eraseIf(std::vector<T>& list, const Gone& gone) {
  list.erase(std::remove_if(list.begin(), list.end(), gone), list.end());
}

}  // namespace

Tree ForestPhysics::grow(const StepContext& context, std::uint32_t tree) const {
  return growTree(context.layout, tree, context.terrain, brokenOf(broken_, tree));
}

// At most one joint of a tree breaks in a tick, the one under the largest stress, because the break
// unloads the others. Joints that blend back follow no load.
void ForestPhysics::breakOverloaded(const StepContext& context, Nanoseconds to) {
  struct Overload {
    std::uint32_t tree;
    std::size_t link;
    double stress;
  };
  std::vector<Overload> all;
  for (const auto& [tree, subtree] : subtrees_) {
    if (subtree.empty()) continue;
    const double strength = context.layout.species[subtree.tree().seed.species].strength;
    if (!(strength > 0.0)) continue;
    Overload most{tree, 0, strength};
    bool breaks = false;
    for (std::size_t i = 0; i < subtree.joints().size(); ++i) {
      const SubtreeJoint& joint = subtree.joints()[i];
      if (joint.branch == 0 || joint.blend != NEVER || subtree.stressOf(i) <= most.stress) continue;
      most = {tree, i, subtree.stressOf(i)};
      breaks = true;
    }
    if (breaks) all.push_back(most);
  }
  unbroken_ = 0;
  for (const Overload& overload : all) {
    if (countBroken(broken_) + cuts_.size() >= MOST_BROKEN) {
      ++unbroken_;
      continue;
    }
    const PhysicalSubtree& subtree = subtrees_.at(overload.tree);
    Break out;
    out.piece = pieceOf(context, overload.tree, overload.link, to);
    out.stress = overload.stress;
    TreePieces pieces(subtree.tree().skeleton, subtree.wood());
    pieces.add(std::move(out));
    takeOff(context, overload.tree, std::move(pieces));
  }
}

// Returns a physical branch with the pose and motion that its joint has at a stamp.
BrokenBranch ForestPhysics::pieceOf(const StepContext& context, std::uint32_t tree,
                                    std::size_t link, Nanoseconds stamp) {
  const PhysicalSubtree& subtree = subtrees_.at(tree);
  BrokenBranch out;
  out.branch = subtree.branches()[link];
  out.stamp = stamp;
  physics::Kinematics motion;
  subtree.kinematicsAt(context.windOf(tree), stamp, scratches_[0], motion);
  out.pose = motion.pose[link];
  out.pose.position = Vec3(subtree.tree().foot + out.pose.position);
  out.velocity = motion.velocity[link];
  out.spin = motion.spin[link];
  limitMotion(out);
  return out;
}

// Takes pieces off a tree, with all that acts on them.
void ForestPhysics::takeOff(const StepContext& context, std::uint32_t tree, TreePieces pieces) {
  if (pieces.list().empty()) return;
  const auto is_gone = [&](const auto& at) { return pieces.isOf(at.branch); };
  const auto is_gone_of_tree = [&](const auto& at) { return at.tree == tree && is_gone(at); };
  for (auto it = grabs_.begin(); it != grabs_.end();) {
    const BranchPoint& point = it->second.point;
    if (!is_gone_of_tree(point)) {
      ++it;
      continue;
    }
    pieces.pieceOf(point.branch).grabs.push_back(it->first);
    ended_.push_back({it->second, EndedGrab::BRANCH_BROKEN});
    it = grabs_.erase(it);
  }
  eraseIf(pushes_, [&](const Push& push) { return is_gone_of_tree(push.point); });
  eraseIf(cuts_, is_gone_of_tree);
  const auto loads = contact_loads_.find(tree);
  if (loads != contact_loads_.end()) eraseIf(loads->second, is_gone);
  const auto contacts = persistent_contacts_.find(tree);
  if (contacts != persistent_contacts_.end()) eraseIf(contacts->second, is_gone);
  for (const Break& piece : pieces.list()) {
    broken_[tree].push_back(piece.piece);
    breaks_.push_back(piece);
    breaks_.back().tree = tree;
  }
  const auto subtree = subtrees_.find(tree);
  if (subtree != subtrees_.end()) {
    subtree->second.breakOff(std::make_shared<const Tree>(grow(context, tree)), settings_.material);
    if (subtree->second.empty()) before_.erase(tree);
  }
  const auto cached = grown_.find(tree);
  if (cached != grown_.end()) {
    grown_branches_ -= cached->second->skeleton.branches.size();
    grown_.erase(cached);
  }
  requestReview(context, tree);
}

}  // namespace vegetation_sim::forest

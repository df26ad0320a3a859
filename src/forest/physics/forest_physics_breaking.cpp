// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Branches that are cut or break.
#include <algorithm>

#include "forest/physics/forest_physics.h"
#include "tree/growth/broken_branch.h"

namespace vegetation_sim::forest {
namespace {

template <class T, class Gone>
void eraseIf(std::vector<T>& list, const Gone& gone) {
  list.erase(std::remove_if(list.begin(), list.end(), gone), list.end());
}

}  // namespace

void checkCut(const Layout& layout, const Tree& tree, const BranchCut& cut) {
  const auto& branches = tree.skeleton.branches;
  if (layout.treeCount() == 0) throw InvalidInput("cut: there are no trees");
  if (cut.tree >= layout.treeCount())
    throw InvalidInput("cut: tree = " + std::to_string(cut.tree) +
                           " is unknown, allowed are 0 to " +
                           std::to_string(static_cast<long>(layout.treeCount()) - 1),
                       FaultCode::UNKNOWN);
  if (cut.branch < 1 || cut.branch >= static_cast<int>(branches.size()))
    throw InvalidInput("cut: branch = " + std::to_string(cut.branch) + " of tree " +
                           std::to_string(cut.tree) + " is outside 1 to " +
                           std::to_string(static_cast<long>(branches.size()) - 1) +
                           "; 0 is the foot of the trunk",
                       cut.branch == 0 ? FaultCode::INVALID_VALUE : FaultCode::UNKNOWN);
  if (branches[index(cut.branch)].broken)
    throw InvalidInput("cut: branch = " + std::to_string(cut.branch) + " of tree " +
                           std::to_string(cut.tree) + " has come off",
                       FaultCode::UNKNOWN);
}

Tree ForestPhysics::grow(const StepContext& context, std::uint32_t tree) const {
  return growTree(context.layout, tree, context.terrain, brokenOf(broken_, tree));
}

void ForestPhysics::cut(const StepContext& context, const BranchCut& cut) {
  if (cut.tree >= context.layout.treeCount()) checkCut(context.layout, Tree(), cut);
  const auto subtree = subtrees_.find(cut.tree);
  if (subtree != subtrees_.end())
    checkCut(context.layout, subtree->second.tree(), cut);
  else
    checkCut(context.layout, grow(context, cut.tree), cut);
  if (countBroken(broken_) + cuts_.size() >= MOST_BROKEN)
    throw InvalidInput(
        "cut: " + std::to_string(MOST_BROKEN) + " branches have come off, and no more can",
        FaultCode::NO_ROOM);
  cuts_.push_back(cut);
}

// Of two cuts in one tick, the second may be of what the first has taken off.
void ForestPhysics::cutBranches(const StepContext& context, Nanoseconds to) {
  for (const BranchCut& cut : std::exchange(cuts_, {})) {
    if (grow(context, cut.tree).skeleton.branches[index(cut.branch)].broken) continue;
    Break out;
    out.tree = cut.tree;
    out.piece = pieceOf(context, cut, context.stamp);
    out.piece.stamp = to;
    out.piece.cut = true;
    const auto subtree = subtrees_.find(cut.tree);
    const int link = subtree == subtrees_.end() ? -1 : subtree->second.linkOf(cut.branch);
    if (link >= 0) out.stress = subtree->second.stressOf(index(link));
    takeOff(context, std::move(out));
  }
}

// At most one joint of a tree breaks in a tick, the one under the largest stress, because the break
// unloads the others. Joints that blend back follow no load.
void ForestPhysics::breakOverloaded(const StepContext& context, Nanoseconds to) {
  std::vector<Break> all;
  for (const auto& [tree, subtree] : subtrees_) {
    if (subtree.empty()) continue;
    const double strength = context.layout.species[subtree.tree().seed.species].strength;
    if (!(strength > 0.0)) continue;
    Break most;
    most.tree = tree;
    most.stress = strength;
    most.piece.branch = 0;
    for (std::size_t i = 0; i < subtree.joints().size(); ++i) {
      const SubtreeJoint& joint = subtree.joints()[i];
      if (joint.branch == 0 || joint.blend != NEVER || subtree.stressOf(i) <= most.stress) continue;
      most.stress = subtree.stressOf(i);
      most.piece.branch = joint.branch;
    }
    if (most.piece.branch > 0) all.push_back(most);
  }
  for (Break& out : all) {
    if (countBroken(broken_) >= MOST_BROKEN) return;
    out.piece = pieceOf(context, {out.tree, out.piece.branch}, to);
    takeOff(context, std::move(out));
  }
}

// Returns a branch with the pose and motion that its joint has at a stamp; one that is not physical
// starts at rest.
BrokenBranch ForestPhysics::pieceOf(const StepContext& context, const BranchCut& at,
                                    Nanoseconds stamp) {
  BrokenBranch out;
  out.branch = at.branch;
  out.stamp = stamp;
  const auto subtree = subtrees_.find(at.tree);
  const int link = subtree == subtrees_.end() ? -1 : subtree->second.linkOf(at.branch);
  if (link < 0) {
    const Tree tree = grow(context, at.tree);
    out.pose = pose(context, tree, at.tree, stamp)[index(at.branch)];
    out.pose.position = Vec3(tree.foot + out.pose.position);
    return out;
  }
  physics::Kinematics motion;
  subtree->second.kinematicsAt(context.windOf(at.tree), stamp, scratches_[0], motion);
  out.pose = motion.pose[index(link)];
  out.pose.position = Vec3(subtree->second.tree().foot + out.pose.position);
  out.velocity = motion.velocity[index(link)];
  out.spin = motion.spin[index(link)];
  return out;
}

// Takes a branch off its tree, with all that acts on it.
void ForestPhysics::takeOff(const StepContext& context, Break out) {
  const std::uint32_t tree = out.tree;
  const auto subtree = subtrees_.find(tree);
  if (subtree != subtrees_.end()) {
    out.mass = subtree->second.wood().subtree[index(out.piece.branch)].mass;
  } else {
    const Tree whole = grow(context, tree);
    const Species& species = context.layout.species[whole.seed.species];
    out.mass =
        woodOf(whole.skeleton, species, Material::BEAM).subtree[index(out.piece.branch)].mass;
  }
  broken_[tree].push_back(out.piece);
  auto grown = std::make_shared<const Tree>(grow(context, tree));
  const auto& branches = grown->skeleton.branches;
  const auto is_gone = [&](const BranchPoint& at) {
    return at.tree == tree && branches[index(at.branch)].broken;
  };
  for (auto it = grabs_.begin(); it != grabs_.end();) {
    if (!is_gone(it->second.point)) {
      ++it;
      continue;
    }
    out.grabs.push_back(it->first);
    ended_.push_back({it->second, EndedGrab::BRANCH_BROKEN});
    it = grabs_.erase(it);
  }
  eraseIf(pushes_, [&](const Push& push) { return is_gone(push.point); });
  const auto loads = contact_loads_.find(tree);
  if (loads != contact_loads_.end())
    eraseIf(loads->second,
            [&](const BranchLoad& load) { return branches[index(load.branch)].broken; });
  const auto contacts = persistent_contacts_.find(tree);
  if (contacts != persistent_contacts_.end())
    eraseIf(contacts->second, [&](const PersistentContact& contact) {
      return branches[index(contact.branch)].broken;
    });
  if (subtree != subtrees_.end()) {
    subtree->second.breakOff(std::move(grown), settings_.material);
    if (subtree->second.empty()) before_.erase(tree);
  }
  next_review_ = 0;
  breaks_.push_back(std::move(out));
}

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Branches that are cut.
#include <utility>

#include "forest/physics/forest_physics.h"
#include "forest/physics/tree_pieces.h"
#include "tree/growth/broken_branch.h"

namespace vegetation_sim::forest {
namespace {

// A scan of all branches takes about this fraction of the time to grow them.
constexpr std::size_t SCANS_PER_GROWTH = 16;

}  // namespace

void checkCut(const Layout& layout, const Tree& tree, const BranchCut& cut) {
  const auto& branches = tree.skeleton.branches;
  if (layout.treeCount() == 0) throw InvalidInput("cut: there are no trees");
  if (cut.tree >= layout.treeCount())
    throw InvalidInput("cut: tree = " + std::to_string(cut.tree) +
                           " is unknown, allowed are 0 to " +
                           std::to_string(static_cast<long>(layout.treeCount()) - 1),
                       FaultCode::UNKNOWN);
  // Messages have unsigned indices.
  const std::string branch = std::to_string(static_cast<std::uint32_t>(cut.branch));
  if (cut.branch < 1 || cut.branch >= static_cast<int>(branches.size()))
    throw InvalidInput(
        "cut: branch = " + branch + " of tree " + std::to_string(cut.tree) + " is outside 1 to " +
            std::to_string(static_cast<long>(branches.size()) - 1) + "; 0 is the foot of the trunk",
        cut.branch == 0 ? FaultCode::INVALID_VALUE : FaultCode::UNKNOWN);
  if (branches[index(cut.branch)].broken)
    throw InvalidInput(
        "cut: branch = " + branch + " of tree " + std::to_string(cut.tree) + " has come off",
        FaultCode::UNKNOWN);
}

// Returns a tree as it stands. Between two ticks, a tree is grown once.
std::shared_ptr<const Tree> ForestPhysics::growToCut(const StepContext& context,
                                                     std::uint32_t tree) {
  const auto subtree = subtrees_.find(tree);
  if (subtree != subtrees_.end()) return subtree->second.sharedTree();
  const auto held = grown_.find(tree);
  if (held != grown_.end()) return held->second;
  auto out = std::make_shared<const Tree>(grow(context, tree));
  ++grown_to_cut_;
  grown_.emplace(tree, out);
  grown_branches_ += out->skeleton.branches.size();
  if (grown_branches_ > MOST_CUT_BRANCHES) forgetGrown();
  return out;
}

void ForestPhysics::forgetGrown() {
  grown_.clear();
  grown_branches_ = 0;
}

void ForestPhysics::cut(const StepContext& context, const BranchCut& cut) {
  if (cut.tree >= context.layout.treeCount()) checkCut(context.layout, Tree(), cut);
  context.owners.requireOwned("cut", cut.tree);
  checkCut(context.layout, *growToCut(context, cut.tree), cut);
  if (countBroken(broken_) + cuts_.size() >= MOST_BROKEN)
    throw InvalidInput(
        "cut: " + std::to_string(MOST_BROKEN) + " branches have come off, and no more can",
        FaultCode::NO_ROOM);
  cuts_.push_back(cut);
}

void ForestPhysics::cutBranches(const StepContext& context, Nanoseconds to) {
  for (std::size_t work = 0; !cuts_.empty() && work < MOST_CUT_BRANCHES;)
    work += cutTree(context, cuts_.front().tree, to, MOST_CUT_BRANCHES - work);
  forgetGrown();
}

// Makes the cuts of one tree, all from its pose at `to`, as far as `most` allows; returns their
// work in branches grown. Of two cuts, the second may be of what the first has taken off.
std::size_t ForestPhysics::cutTree(const StepContext& context, std::uint32_t tree, Nanoseconds to,
                                   std::size_t most) {
  const std::shared_ptr<const Tree> grown = growToCut(context, tree);
  const Species& species = context.layout.species[grown->seed.species];
  const auto subtree = subtrees_.find(tree);
  const bool is_physical = subtree != subtrees_.end();
  const Wood wood =
      is_physical ? subtree->second.wood() : woodOf(grown->skeleton, species, Material::BEAM);
  const std::vector<Pose> poses =
      poseBranches(*grown, context.wind.at(to).relativeTo(grown->foot),
                   weightsAt(context.levels.of(tree), to, context.layout.motion),
                   context.modes.find(tree), promoted(tree, to), to);
  TreePieces pieces(grown->skeleton, wood);
  const std::size_t branches = grown->skeleton.branches.size();
  std::size_t work = branches * (is_physical ? 2 : 1);
  std::vector<BranchCut> later;
  for (const BranchCut& cut : std::exchange(cuts_, {})) {
    if (cut.tree != tree || (work >= most && !pieces.list().empty())) {
      later.push_back(cut);
      continue;
    }
    if (pieces.isGone(cut.branch)) continue;
    pieces.add(cutOff(context, cut, poses[index(cut.branch)], to));
    work += (branches + pieces.list().size()) / SCANS_PER_GROWTH;
  }
  cuts_ = std::move(later);
  takeOff(context, tree, std::move(pieces));
  return work;
}

// Returns a branch that is cut. One that is not physical starts at rest from `pose`, tree's frame.
Break ForestPhysics::cutOff(const StepContext& context, const BranchCut& cut, const Pose& pose,
                            Nanoseconds stamp) {
  Break out;
  const auto subtree = subtrees_.find(cut.tree);
  const int link = subtree == subtrees_.end() ? -1 : subtree->second.linkOf(cut.branch);
  if (link >= 0) {
    out.piece = pieceOf(context, cut.tree, index(link), stamp);
    out.stress = subtree->second.stressOf(index(link));
  } else {
    out.piece.branch = cut.branch;
    out.piece.stamp = stamp;
    out.piece.pose = pose;
    const Vec3 foot = footOf(seedOf(context.layout, cut.tree), context.terrain);
    out.piece.pose.position = Vec3(foot + pose.position);
  }
  out.piece.cut = true;
  return out;
}

}  // namespace vegetation_sim::forest

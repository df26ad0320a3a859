// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/leafed_crowns.h"

#include <algorithm>

namespace vegetation_sim {
namespace {

// Leaves hang where the species has them, or on the last limbs of a species without leaves.
std::vector<canopy::Twig> twigsOf(const forest::Tree& tree) {
  const forest::Skeleton& skeleton = tree.skeleton;
  bool leafed = false;
  for (const forest::Branch& branch : skeleton.branches) leafed = leafed || branch.leaves > 0;
  std::vector<canopy::Twig> out;
  for (const forest::Branch& branch : skeleton.branches) {
    canopy::Twig twig;
    twig.pose = {Vec3(tree.foot + branch.rest.position), branch.rest.orientation};
    twig.length = branch.length;
    const bool last = branch.depth + 1 == skeleton.depths();
    twig.share = leafed ? branch.leaves : (last ? branch.length : 0.0);
    out.push_back(twig);
  }
  return out;
}

// Removes the leaves of branches that have come off. The others stay where they were.
void dropLeaves(const forest::Skeleton& skeleton, std::vector<canopy::CrownLeaf>& leaves) {
  const auto gone = [&](const canopy::CrownLeaf& leaf) {
    return skeleton.branches[leaf.twig].broken;
  };
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(), gone), leaves.end());
}

canopy::LeafBox boxOf(const std::vector<canopy::CrownLeaf>& leaves) {
  canopy::LeafBox out;
  if (leaves.empty()) return out;
  out.low = out.high = leaves.front().leaf.anchor;
  for (const canopy::CrownLeaf& leaf : leaves) {
    out.low = out.low.cwiseMin(leaf.leaf.anchor);
    out.high = out.high.cwiseMax(leaf.leaf.anchor);
  }
  return out;
}

}  // namespace

std::vector<canopy::LeafBox> LeafedCrowns::boxes() const {
  std::vector<canopy::LeafBox> out;
  for (const Crown& crown : crowns_)
    if (!crown.leaves.empty()) out.push_back(crown.box);
  return out;
}

LeafedCrowns::Crown LeafedCrowns::growCrown(const canopy::Layout& layout,
                                            const forest::ForestReplica& forest, std::uint16_t kind,
                                            const forest::Tree& tree, std::uint32_t id) {
  Crown out;
  out.tree = id;
  out.kind = kind;
  out.broken = brokenOf(forest.broken(), id);
  out.rest = twigsOf(growTree(forest.layout(), id, forest.terrain()));
  out.leaves = canopy::growCrown(layout.kinds[kind], tree.seed.seed, out.rest);
  dropLeaves(tree.skeleton, out.leaves);
  out.box = boxOf(out.leaves);
  return out;
}

void LeafedCrowns::grow(const canopy::Layout& layout, const forest::ForestReplica& forest) {
  crowns_.clear();
  trees_.clear();
  const std::uint32_t count = forest.layout().treeCount();
  for (const canopy::CrownRule& rule : layout.crowns)
    for (int i = 0; i < rule.trees; ++i) {
      const auto tree = static_cast<std::uint32_t>(rule.first_tree + i);
      if (tree >= count) break;
      trees_.push_back(forest.grow(tree));
      crowns_.push_back(growCrown(layout, forest, rule.kind, trees_.back(), tree));
    }
}

bool LeafedCrowns::regrowBroken(const canopy::Layout& layout, const forest::ForestReplica& forest) {
  bool out = false;
  for (std::size_t i = 0; i < crowns_.size(); ++i) {
    Crown& crown = crowns_[i];
    if (crown.broken == brokenOf(forest.broken(), crown.tree)) continue;
    trees_[i] = forest.grow(crown.tree);
    crown = growCrown(layout, forest, crown.kind, trees_[i], crown.tree);
    out = true;
  }
  return out;
}

bool LeafedCrowns::update(const canopy::Layout& layout, const SubscribedForest& forest) {
  if (forests_ == forest.layouts()) return regrowBroken(layout, forest.replica());
  forests_ = forest.layouts();
  grow(layout, forest.replica());
  return true;
}

void LeafedCrowns::clear() {
  crowns_.clear();
  trees_.clear();
  forests_ = 0;
}

std::vector<Pose> LeafedCrowns::wood(std::size_t crown, const forest::ForestReplica& forest,
                                     Nanoseconds stamp) const {
  const forest::Tree& tree = trees_[crown];
  std::vector<Pose> out = forest.pose(tree, crowns_[crown].tree, stamp);
  for (Pose& pose : out) pose.position = Vec3(tree.foot + pose.position);
  return out;
}

}  // namespace vegetation_sim

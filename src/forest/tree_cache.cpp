// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/tree_cache.h"

#include "forest/forest.h"

namespace vegetation_sim::forest {

std::shared_ptr<const TreeCache::Grown> TreeCache::get(const Layout& layout,
                                                       const terrain::HeightMap& terrain,
                                                       std::uint32_t tree,
                                                       const BrokenBranches& broken) {
  const auto found = held_.find(tree);
  if (found != held_.end() && !(found->second->grown->broken == broken)) {
    remove(tree);
  } else if (found != held_.end()) {
    recent_.splice(recent_.begin(), recent_, found->second);
    return found->second->grown;
  }
  auto grown = std::make_shared<const Grown>(growTree(layout, tree, terrain, broken), broken);
  branches_ += grown->tree.skeleton.branches.size();
  recent_.push_front({tree, grown});
  held_[tree] = recent_.begin();
  while (branches_ > capacity_ && recent_.size() > 1) remove(recent_.back().tree);
  return grown;
}

std::shared_ptr<const TreeCache::Grown> TreeCache::get(const Forest& forest, std::uint32_t tree) {
  return get(forest.layout(), forest.terrain(), tree, brokenOf(forest.broken(), tree));
}

void TreeCache::remove(std::uint32_t tree) {
  const auto found = held_.find(tree);
  branches_ -= found->second->grown->tree.skeleton.branches.size();
  recent_.erase(found->second);
  held_.erase(found);
}

void TreeCache::clear() {
  branches_ = 0;
  recent_.clear();
  held_.clear();
}

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/tree_cache.h"

namespace vegetation_sim::forest {

std::shared_ptr<const TreeCache::Grown> TreeCache::get(const Layout& layout,
                                                       const terrain::HeightMap& terrain,
                                                       std::uint32_t tree) {
  const auto found = held_.find(tree);
  if (found != held_.end()) {
    recent_.splice(recent_.begin(), recent_, found->second);
    return found->second->grown;
  }
  auto grown = std::make_shared<const Grown>(growTree(layout, tree, terrain));
  branches_ += grown->tree.skeleton.branches.size();
  recent_.push_front({tree, grown});
  held_[tree] = recent_.begin();
  while (branches_ > capacity_ && recent_.size() > 1) {
    branches_ -= recent_.back().grown->tree.skeleton.branches.size();
    held_.erase(recent_.back().tree);
    recent_.pop_back();
  }
  return grown;
}

void TreeCache::clear() {
  branches_ = 0;
  recent_.clear();
  held_.clear();
}

}  // namespace vegetation_sim::forest

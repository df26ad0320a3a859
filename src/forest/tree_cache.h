// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

class Forest;

/// A cache of grown trees that drops the least recently used ones: only seeds are permanent
/// (S1-04).
class TreeCache {
 public:
  struct Grown {
    Grown(Tree grown, BrokenBranches gone)
        : tree(std::move(grown)), poser(tree), broken(std::move(gone)) {}
    Tree tree;
    BatchPoser poser;
    BrokenBranches broken;  ///< what has come off it
  };

  /// @param capacity maximum number of branches in all; the cache holds at least one tree.
  explicit TreeCache(std::size_t capacity) : capacity_(capacity) {}

  /// Returns the tree and grows it if necessary. @throws std::out_of_range for an unknown id.
  std::shared_ptr<const Grown> get(const Layout& layout, const terrain::HeightMap& terrain,
                                   std::uint32_t tree, const BrokenBranches& broken = {});
  /// Returns a tree as it stands in the forest.
  std::shared_ptr<const Grown> get(const Forest& forest, std::uint32_t tree);
  void clear();
  std::size_t branches() const { return branches_; }

 private:
  void remove(std::uint32_t tree);

  struct Slot {
    std::uint32_t tree;
    std::shared_ptr<const Grown> grown;
  };
  std::size_t capacity_;
  std::size_t branches_{0};
  std::list<Slot> recent_;  // last used first
  std::map<std::uint32_t, std::list<Slot>::iterator> held_;
};

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

/// A cache of grown trees that drops the least recently used ones: only seeds are permanent
/// (S1-04).
class TreeCache {
 public:
  struct Grown {
    explicit Grown(Tree grown) : tree(std::move(grown)), poser(tree) {}
    Tree tree;
    BatchPoser poser;
  };

  /// @param capacity maximum number of branches in all; the cache holds at least one tree.
  explicit TreeCache(std::size_t capacity) : capacity_(capacity) {}

  /// Returns the tree and grows it if necessary. @throws std::out_of_range for an unknown id.
  std::shared_ptr<const Grown> get(const Layout& layout, const terrain::HeightMap& terrain,
                                   std::uint32_t tree);
  void clear();
  std::size_t branches() const { return branches_; }

 private:
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

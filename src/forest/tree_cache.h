// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

/// Trees that are in use, grown on demand and forgotten when others need the room: only seeds are
/// permanent (S1-04).
class TreeCache {
 public:
  struct Grown {
    explicit Grown(Tree grown) : tree(std::move(grown)), poser(tree) {}
    Tree tree;
    BatchPoser poser;
  };

  /// @param capacity most branches held in all; at least one tree is.
  explicit TreeCache(std::size_t capacity) : capacity_(capacity) {}

  /// The tree, grown now if it is not held. @throws std::out_of_range for an unknown id.
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

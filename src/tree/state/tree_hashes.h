// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::forest {

/// A hash of each tree that has state of its own, and their sum, which depends on no order of the
/// trees: sums of disjoint sets of trees add up.
class TreeHashes {
 public:
  /// Kinds of state of a tree, each added in a fixed order.
  enum Kind : std::uint64_t { LEVEL, MODES, REQUEST, GRAB, PUSH, CUT, BROKEN, JOINTS, CONTACT };

  /// Returns the hash of a tree, to which values of a kind are added next.
  Hash& of(std::uint32_t tree, Kind kind) {
    const auto [entry, is_new] = hashes_.try_emplace(tree);
    if (is_new) entry->second.add(std::uint64_t{tree});
    entry->second.add(static_cast<std::uint64_t>(kind));
    return entry->second;
  }
  /// Returns the sum modulo 2^64; 0 without trees.
  std::uint64_t sum() const;

 private:
  std::map<std::uint32_t, Hash> hashes_;
};

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "physics/chain_levels.h"
#include "physics/chain_rows.h"

namespace vegetation_sim::physics {

/// Joints that are swept together: small trees, the stem of a large tree, or some of the sub-trees
/// that hang on it.
struct ChainPart {
  std::vector<Level> levels;
  int begin{0}, end{0};    ///< its slots, multiples of ROW
  std::vector<int> roots;  ///< [first level] place in the group's `hung`; none: on bases
};

/// Sorts joints into parts of at most `most` and their slots from `begin` on. parents: [joints]
/// below the own index, or -1. Not more than `most` joints are one part. Of more, the first part is
/// the stem, all roots and whatever carries more than half of `most`; the sub-trees that hang on it
/// fill the others. hung: one for each of those, at the slot of the joint that it hangs on,
/// ascending. Appends the slot of each joint; returns one past the last slot.
int sortIntoParts(const std::vector<int>& parents, std::size_t most, int begin,
                  std::vector<ChainPart>& parts, std::vector<JointRows>& hung,
                  std::vector<int>& slots);

}  // namespace vegetation_sim::physics

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace vegetation_sim::physics {

/// The r-th children of a level's joints, which stand side by side in the next level in their
/// parents' order. So whatever the vector's width, the r-th children of neighbours are neighbours:
/// values pass with one permutation and no gather, and parents sum their children by rank.
struct Brood {
  int parents{0};                   ///< joints of the level up to the last that has such a child
  int end{0};                       ///< one past the last such child in the next level
  std::vector<std::int32_t> first;  ///< place in the next level of such children of joint i and on
};

/// Joints of equal depth, padded to whole rows.
struct Level {
  int begin{0};  ///< first slot, a multiple of ROW
  int count{0};
  std::vector<Brood> broods;  ///< by rank
};

/// Sorts the joints of some trees into levels that begin at slot `begin`. parents: [joints] below
/// the own index, or -1. Appends the slot of each joint; returns one past the last slot.
int sortIntoLevels(const std::vector<int>& parents, int begin, std::vector<Level>& levels,
                   std::vector<int>& slots);

}  // namespace vegetation_sim::physics

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace vegetation_sim::physics {

/// The r-th children of a level's joints, side by side in the next level in the order of their
/// parents. For any vector width, the r-th children of neighbours are neighbours: values pass with
/// one permutation and no gather, and parents sum their children by rank.
struct ChildRank {
  int parents{0};  ///< number of joints of the level up to the last that has such a child
  int end{0};      ///< one past the last such child in the next level
  /// position in the next level of the first such child of joint i or later
  std::vector<std::int32_t> first;
};

/// Joints of equal depth, padded to whole rows.
struct Level {
  int begin{0};  ///< first slot, a multiple of ROW
  int count{0};
  std::vector<ChildRank> child_ranks;  ///< by rank
};

/// Sorts the joints of some trees into levels that begin at slot `begin`. `parents` [joints] are
/// lower than the own index, or -1. Appends the slot of each joint and returns one past the last
/// slot.
int sortIntoLevels(const std::vector<int>& parents, int begin, std::vector<Level>& levels,
                   std::vector<int>& slots);

}  // namespace vegetation_sim::physics

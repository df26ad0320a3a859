// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forest/detail/promotion_offsets.h"
#include "forest/detail/tree_detail.h"

namespace vegetation_sim::forest {

/// The trees as one group of listeners has them: sensors, or displays. It affects neither the world
/// nor the other group, and is in no hash. A value.
struct ListenerDetail {
  TreeDetail trees;
  PromotionOffsets offsets;

  void reset(int level) {
    trees.reset(level);
    offsets.clear();
  }
};

}  // namespace vegetation_sim::forest

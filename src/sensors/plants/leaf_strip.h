// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/strip.h"
#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::scan {

/// Returns the strip of a leaf where it has moved to.
inline Strip stripOf(const canopy::Leaf& leaf, const canopy::MovedLeaf& moved) {
  return {moved.root, moved.tip, double{leaf.root_width} * moved.side,
          double{leaf.tip_width} * moved.side};
}

}  // namespace vegetation_sim::scan

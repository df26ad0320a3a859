// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim::view {

/// Extends the feet of ribbons into the ground, so that they stand in it, and draws the tips of
/// those that are whole to a point. Pieces of a ribbon follow each other, each from the tip of the
/// one before. Leaves that lie on the ground stay as they are.
void finishRibbons(bool whole, std::vector<canopy::Leaf>& leaves);

/// Returns whether a piece has such a foot.
inline bool isFoot(const canopy::Leaf& leaf) {
  return !leaf.lies && leaf.root.z() < leaf.anchor.z();
}

}  // namespace vegetation_sim::view

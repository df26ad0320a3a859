// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::view {

/// Draws the last piece of each limb to a point. Where the next piece has come off, and at the foot
/// of a piece that has come off, it adds a round cap.
void finishLimbEnds(const forest::Skeleton& skeleton, forest::TreeMesh& mesh);

}  // namespace vegetation_sim::view

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::view {

/// Folds the cards that show clusters along a diagonal, so that a near card has depth and is never
/// seen as a line. Cards that show boughs, which are far, stay flat.
/// @param positions corners of all cards of the mesh, as skinLeaves() writes them.
void foldClusters(const forest::TreeMesh& mesh, float* positions);

}  // namespace vegetation_sim::view

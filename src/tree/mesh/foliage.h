// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/mesh/mesh.h"

namespace vegetation_sim::forest {

/// Returns the leaf cards of a mesh: a pure function of skeleton, species and detail. Fewer cards
/// are a subset of more, so that leaves stay in place between levels.
std::vector<LeafCard> placeLeaves(const Skeleton& skeleton, const Species& species,
                                  const MeshDetail& detail);

}  // namespace vegetation_sim::forest

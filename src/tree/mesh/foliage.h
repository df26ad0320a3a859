// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::forest {

/// Adds the leaf cards of a mesh, a pure function of skeleton, species and detail, those that show
/// clusters first. Fewer cards are a subset of more, so that leaves stay in place between levels.
/// @return the number of cards that show clusters.
std::size_t placeLeaves(const Skeleton& skeleton, const Species& species,
                        const TreeMeshDetail& detail, std::vector<LeafCard>& out);

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/mesh/mesh.h"

namespace vegetation_sim::forest {

/// The leaf cards of a mesh: a pure function of skeleton, species and detail. Fewer are a subset of
/// more, so that trees do not reshuffle their leaves from level to level.
std::vector<LeafCard> placeLeaves(const Skeleton& skeleton, const Species& species,
                                  const MeshDetail& detail);

}  // namespace vegetation_sim::forest

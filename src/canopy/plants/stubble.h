// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim::canopy {

/// A leaf, or piece of a ribbon, that was cut off.
struct FallenLeaf {
  Leaf leaf;              ///< where it grew
  std::size_t number{0};  ///< among the leaves of the whole plant
};

/// Removes what hangs above a height or grows through it [m, world]: leaves and faces whose root or
/// anchor is above it, stems that begin above it, and all pieces of a ribbon after the one that is
/// cut. Stems and single leaves that grow through it end there; a face of a mesh is kept whole.
/// @return the leaves that are removed whole, without faces of meshes.
std::vector<FallenLeaf> cutOff(double z, GrownPlant& plant);

/// @param plants number of plants of the layout. @throws InvalidInput for unknown plants, and
/// heights outside CUT_HEIGHTS.
void checkStubble(const Stubble& stubble, std::size_t plants, const std::string& context);

}  // namespace vegetation_sim::canopy

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grass/mesh/grass_geometry.h"

namespace vegetation_sim::grass {

/// Appends one ribbon after the other, with the same bits as appendRibbons().
void appendRibbonsPlain(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks,
                        int count, const RibbonStyle& style, GrassMesh& mesh);

}  // namespace vegetation_sim::grass

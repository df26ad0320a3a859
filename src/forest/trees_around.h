// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// Returns the trees whose seed stands within `radius` [m] of a point in the horizontal plane, the
/// nearest first; of trees at equal distance the one of the lower id.
std::vector<std::uint32_t> treesAround(const Layout& layout, const Vec3& centre, double radius);

}  // namespace vegetation_sim::forest

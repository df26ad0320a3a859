// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/grass/tread/cut_map.h"

namespace vegetation_sim {

/// Returns the ids of the plants whose feet are in a checked area. @throws InvalidInput if corners
/// times plants exceed the work of about half a second.
std::vector<std::uint32_t> plantsIn(const std::vector<canopy::Plant>& plants,
                                    const grass::CutArea& area);

}  // namespace vegetation_sim

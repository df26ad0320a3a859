// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <array>
#include <string>

#include "grass/tread_simulation.h"

namespace vegetation_sim {

/// Value of a cell of the cover map (N5): tilt of its most trodden node, blades per area, drag,
/// or time since it was trodden.
enum class CoverLayer : int { CRUSH = 0, DENSITY = 1, RESISTANCE = 2, AGE = 3 };
constexpr std::array<const char*, 4> COVER_LAYERS = {"crush", "density", "resistance", "age"};

struct CoverSettings {
  double resolution{0.25};  ///< side of a cell [m]
  double full_age{600.0};   ///< age that counts as 100 [s]
};

/// A layer in percent: CRUSH of the largest tilt, DENSITY and RESISTANCE of the largest on the map,
/// AGE of full_age; -1: not trodden (AGE). The header's frame is left to the caller.
nav_msgs::OccupancyGrid coverOf(const grass::TreadSimulation& field, CoverLayer layer,
                                const CoverSettings& settings);

}  // namespace vegetation_sim

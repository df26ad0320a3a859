// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <vegetation_sim/GrassCover.h>
#include <vegetation_sim/GrassCoverPart.h>

#include <array>

#include "grass/tread_simulation.h"

namespace vegetation_sim {

/// A layer of the cover map (N5): tilt of the most trodden node of a cell, blades per area, drag
/// per speed, time since it was trodden, or share of it that is cut.
enum class CoverLayer : int { CRUSH = 0, DENSITY = 1, RESISTANCE = 2, AGE = 3, CUT = 4 };
constexpr std::array<const char*, 5> COVER_LAYERS = {"crush", "density", "resistance", "age",
                                                     "cut"};

/// Values that the layers in percent show as 100. They do not depend on the meadow, so equal grass
/// has equal percentages on every map.
struct CoverScale {
  double density{1000.0};    ///< [1/m^2]
  double resistance{100.0};  ///< [N/(m/s)], on one metre of width
  double age{600.0};         ///< [s]
};

/// Computes the grid, density and height, which do not change. @param resolution edge of a cell
/// [m].
GrassCover groundOf(const grass::FeatureMap& map, double resolution);
/// Returns the trodden cells of a grid of this resolution. Left to the caller: frame and shard.
GrassCoverPart troddenCells(const grass::TreadSimulation& field, const nav_msgs::MapMetaData& info,
                            double resolution);
/// Completes the ground of this resolution by the layers that treads and cuts change, but for
/// `resistance`. Left to the caller: the frame.
GrassCover coverOf(const grass::TreadSimulation& field, GrassCover ground, double resolution);
/// Adds trodden cells of another shard; of a cell of both the most trodden node counts.
void addTreads(const GrassCoverPart& part, GrassCover& cover);
/// Computes `resistance` from the other layers. @param drag see TreadSimulation::drag().
void addResistance(double drag, GrassCover& cover);

/// Returns a layer in percent of its scale, at most 100; CRUSH of the largest tilt. -1: untrodden
/// (AGE).
nav_msgs::OccupancyGrid percentOf(const GrassCover& cover, CoverLayer layer,
                                  const CoverScale& scale);

}  // namespace vegetation_sim

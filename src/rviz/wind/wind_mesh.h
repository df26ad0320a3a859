// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "grass/mesh/grass_geometry.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::view {

/// Style of arrows and shapes.
struct WindStyle {
  double spacing{3.0};      ///< of the arrows [m]
  double extent{60.0};      ///< edge of the square of arrows [m]
  double height{2.0};       ///< over the ground [m]
  double scale{0.25};       ///< length of an arrow over its speed [s]
  double full_speed{12.0};  ///< speed of the last colour [m/s]
  bool red_discs{false};    ///< otherwise discs have the colour of their speed, as all shapes
};

/// Largest number of arrows. The spacing grows so that it is not exceeded.
constexpr int MOST_ARROWS = 4096;

/// Returns a colour from blue over green and yellow to red. @param share of the full speed.
Vec3 colourOfSpeed(double share);

/// Appends an arrow of two crossed blades, unless the vector is shorter than 1 mm.
void appendArrow(const Vec3& from, const Vec3& vector, const Vec3& colour, grass::GrassMesh& mesh);

/// Appends arrows around a place, on a grid that is fixed in the world. Returns their number.
std::size_t appendArrows(const wind::Instant& wind, const terrain::HeightMap& ground,
                         const Vec3& around, const WindStyle& style, grass::GrassMesh& mesh);

/// Appends the bounds of a primitive on the ground, and its arrow.
void appendTerm(const wind::Term& term, const terrain::HeightMap& ground, const WindStyle& style,
                grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "grass/mesh/grass_geometry.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::view {

/// How wind is drawn.
struct WindStyle {
  double spacing{3.0};      ///< of the arrows [m]
  double extent{60.0};      ///< edge of their square [m]
  double height{2.0};       ///< over the ground [m]
  double scale{0.25};       ///< length of an arrow a speed [s]
  double full_speed{12.0};  ///< that has the last colour [m/s]
};

/// Most arrows: beyond, they are farther apart.
constexpr int MOST_ARROWS = 4096;

/// Blue in a calm over green and yellow to red, by share of the full speed.
Vec3 colourOfSpeed(double share);

/// Appends an arrow of two crossed blades. Nothing for a vector of less than 1 mm.
void appendArrow(const Vec3& from, const Vec3& vector, const Vec3& colour, grass::GrassMesh& mesh);

/// Appends arrows on a grid around a place, which stays where it is when the place moves.
/// @return their number.
std::size_t appendArrows(const wind::Instant& wind, const terrain::HeightMap& ground,
                         const Vec3& around, const WindStyle& style, grass::GrassMesh& mesh);

/// Appends what bounds a primitive on the ground, with an arrow of its own.
void appendTerm(const wind::Term& term, const terrain::HeightMap& ground, const WindStyle& style,
                grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view

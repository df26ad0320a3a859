// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::view {

/// Colours of the light outdoors, sRGB. One set for sky, haze, ground and leaves, so that they
/// agree.
struct Daylight {
  Vec3 to_sun{Vec3(0.5, -0.6, 0.62)};  ///< direction, unit
  Rgba sun{1.46f, 1.28f, 0.96f, 1.f};  ///< light of the sun; above 1 is brighter than the paint
  Rgba zenith_light{0.50f, 0.57f, 0.66f, 1.f};  ///< light of the sky from above
  Rgba ground_light{0.27f, 0.28f, 0.18f, 1.f};  ///< light that the ground throws back
  Rgba zenith{0.24f, 0.44f, 0.74f, 1.f};
  Rgba horizon{0.77f, 0.84f, 0.88f, 1.f};  ///< of the sky, and of the haze
  Rgba glow{1.f, 0.93f, 0.78f, 1.f};       ///< around the sun
};

/// Daylight for the sun's azimuth (0 = east, counter-clockwise) and elevation [rad].
Daylight daylightOf(double azimuth, double elevation);

/// Clouds and far hills, whatever the light: what a sky takes longest to paint.
struct SkyShapes {
  SkyShapes(int columns_wanted, int rows_wanted);

  int columns, rows;
  std::vector<float> clouds;  ///< [rows x columns] density
  std::vector<float> hills;   ///< [columns] sine of their elevation
};

/// The sky over azimuth (columns: once around from east, counter-clockwise) and elevation (rows:
/// the zenith on top, the horizon at the bottom), with soft clouds and far hills.
Image skyPicture(const Daylight& light, const SkyShapes& shapes);
/// Elevation [rad] of a row, v = 0 at the top to 1 at the bottom: finer towards the horizon.
double skyElevation(double v);

}  // namespace vegetation_sim::view

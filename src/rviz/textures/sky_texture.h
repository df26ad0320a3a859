// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::view {

/// Outdoor light in sRGB, one set for sky, haze, ground and leaves.
struct Daylight {
  Vec3 to_sun{Vec3(0.5, -0.6, 0.62)};  ///< direction, unit
  Rgba sun{1.46f, 1.28f, 0.96f, 1.f};  ///< sunlight; values above 1 are brighter than the paint
  Rgba zenith_light{0.50f, 0.57f, 0.66f, 1.f};  ///< skylight from above
  Rgba ground_light{0.27f, 0.28f, 0.18f, 1.f};  ///< light reflected by the ground
  Rgba zenith{0.24f, 0.44f, 0.74f, 1.f};
  Rgba horizon{0.77f, 0.84f, 0.88f, 1.f};  ///< colour of sky and haze there
  Rgba glow{1.f, 0.93f, 0.78f, 1.f};       ///< around the sun
};

/// Returns the daylight for an azimuth of the sun (0 = east, counter-clockwise) and elevation
/// [rad].
Daylight daylightOf(double azimuth, double elevation);

/// Clouds, far hills and woods before them, which do not depend on the light and take longest to
/// paint.
struct SkyShapes {
  SkyShapes(int columns_wanted, int rows_wanted);

  int columns, rows;
  std::vector<float> clouds;  ///< [rows x columns] density
  std::vector<float> hills;   ///< [columns] sine of their elevation
  std::vector<float> woods;   ///< likewise
};

/// Paints the sky with clouds, far hills and woods. Columns are the azimuth, counter-clockwise from
/// east; rows are the elevation from the zenith at the top to the horizon at the bottom.
Image skyPicture(const Daylight& light, const SkyShapes& shapes);
/// Returns the elevation [rad] of a row, v = 0 at the top to 1 at the bottom; rows are finer
/// towards the horizon.
double skyElevation(double v);

}  // namespace vegetation_sim::view

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/blade_widths.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double MOST_LEAVING = 0.5;                       // part of the blades
constexpr double SIBLINGS_FADE = 3.0, SIBLINGS_END = 7.0;  // [m] where siblings narrow to nothing
constexpr double NARROWEST_SIBLING = 0.05;                 // factor of the width
constexpr double THINNED = 0.5;  // share of the blades that strips replace where these cover all

// Returns the width of siblings beside blades that are so many times as wide.
double besideOf(double broad, double distance) {
  if (broad <= 1.0) return 0.0;
  const double share =
      std::clamp((SIBLINGS_END - distance) / (SIBLINGS_END - SIBLINGS_FADE), 0.0, 1.0);
  const double out = share * std::min(broad / 2.0, broad - 1.0);
  return out > NARROWEST_SIBLING ? out : 0.0;
}

}  // namespace

BladeWidths widthsOf(const grass::TileView& tile, double distance, bool strips) {
  BladeWidths out;
  out.leaving = std::min(MOST_LEAVING, (1.0 - tile.share) / tile.share);
  // Fewer blades hide each other less.
  const double broad = std::pow(tile.share * (1.0 - 0.5 * out.leaving), -0.95);
  out.beside = besideOf(broad, distance);
  out.own = broad - out.beside;
  if (!strips) return out;
  const double upright = 1.0 - grass::layerWeight(tile.elevation);
  for (double* width : {&out.own, &out.beside})
    *width += upright * (std::min(WIDEST_BLADE, *width) - *width);
  const double covered = (out.own + out.beside) / broad;
  out.kept = 1.0 - THINNED * (1.0 - covered);
  out.missing = 1.0 - out.kept * covered;
  return out;
}

}  // namespace vegetation_sim::view

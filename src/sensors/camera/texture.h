// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "sensors/geometry/beer_lambert.h"

namespace vegetation_sim::scan {

// Textures of surfaces as functions of the place, so that they need no memory and are the same in
// every picture.

/// Returns a smooth random function of the place, 0 to 1, with features of one unit.
inline double smoothNoise(const Vec3& place, std::uint32_t key) {
  const Cell cell = cellAt(place, 1.0);
  const auto weight = [](double x) { return x * x * (3.0 - 2.0 * x); };
  const double u = weight(place.x() - cell.x), v = weight(place.y() - cell.y),
               w = weight(place.z() - cell.z);
  double out = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double share = (x ? u : 1.0 - u) * (y ? v : 1.0 - v) * (z ? w : 1.0 - w);
    if (share > 0.0) out += share * shareOf({cell.x + x, cell.y + y, cell.z + z}, key);
  }
  return out;
}

/// Returns the mean of octaves, each twice as fine and with half of the weight of the one before.
inline double fractalNoise(const Vec3& place, int octaves, std::uint32_t key) {
  double sum = 0.0, weights = 0.0, weight = 1.0, scale = 1.0;
  for (int i = 0; i < octaves; ++i, weight *= 0.5, scale *= 2.0) {
    sum += weight * smoothNoise(scale * place, key + static_cast<std::uint32_t>(i));
    weights += weight;
  }
  return sum / weights;
}

/// Returns a vector within the unit cube around the origin that belongs to a cell.
inline Vec3 randomVector(const Cell& cell, std::uint32_t key) {
  const auto part = [&](std::uint32_t more) { return 2.0 * shareOf(cell, key + more) - 1.0; };
  return {part(101), part(102), part(103)};
}

}  // namespace vegetation_sim::scan

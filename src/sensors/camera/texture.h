// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "sensors/media/beer_lambert.h"

namespace vegetation_sim::scan {

// Textures of surfaces as functions of the place, so that they need no memory and are the same in
// every picture.

/// Returns a smooth random function of the place, 0 to 1, with features of one unit.
inline double smoothNoise(const Vec3& place, std::uint32_t key) {
  std::uint32_t low[3];
  double weight[3];  // of the upper neighbour along each axis
  for (int i = 0; i < 3; ++i) {
    const double at = std::min(std::max(place[i], -1e9), 1e9);
    const auto cell = static_cast<std::int32_t>(at);
    const std::int32_t below = at < cell ? cell - 1 : cell;
    const double part = at - below;
    low[i] = static_cast<std::uint32_t>(below);
    weight[i] = part * part * (3.0 - 2.0 * part);
  }
  // The random number of a corner is that of shareOf().
  double out = 0.0;
  for (std::uint32_t x = 0; x < 2; ++x) {
    const std::uint32_t of_x = mix32((low[0] + x) ^ key);
    const double share_x = x ? weight[0] : 1.0 - weight[0];
    for (std::uint32_t y = 0; y < 2; ++y) {
      const std::uint32_t of_y = mix32(of_x + low[1] + y);
      const double share = share_x * (y ? weight[1] : 1.0 - weight[1]);
      out += share * (1.0 - weight[2]) * mix32(of_y + low[2]);
      if (weight[2] > 0.0) out += share * weight[2] * mix32(of_y + low[2] + 1);
    }
  }
  return out * (1.0 / 4294967296.0);
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

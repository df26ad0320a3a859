// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

// Leaves and blades are media: the probability that a ray passes a length l of them is exp(-s l).
// The random number belongs to the place, not to the ray or the time, so that a static scene gives
// static returns from every viewpoint.

/// Cube of space with one random number.
struct Cell {
  std::int32_t x{0}, y{0}, z{0};
};

inline Cell cellAt(const Vec3& place, double size) {
  const auto index = [&](double at) {
    // This equals std::floor of std::fmax and std::fmin, NaN included, which take longer.
    double x = at / size;
    x = x > -2e9 ? x : -2e9;
    x = x < 2e9 ? x : 2e9;
    const auto towards_zero = static_cast<std::int32_t>(x);
    return towards_zero - (x < towards_zero ? 1 : 0);
  };
  return {index(place.x()), index(place.y()), index(place.z())};
}

/// Returns the share of rays that are stopped before the optical depth of a cell: uniform, between
/// 0 and 1.
inline double shareOf(const Cell& cell, std::uint32_t key) {
  const std::uint32_t bits = mix32(
      mix32(mix32(static_cast<std::uint32_t>(cell.x) ^ key) + static_cast<std::uint32_t>(cell.y)) +
      static_cast<std::uint32_t>(cell.z));
  return (static_cast<double>(bits) + 0.5) / 4294967296.0;
}

/// Returns the optical depth that a cell transmits: exponentially distributed, mean 1.
inline double depthAt(double share) {
  return -std::log1p(-share);
}

/// Returns whether the depth may be below `most`, without the logarithm: a depth is never less than
/// its share.
inline bool mayBeBelow(double most, double share) {
  return share < most * (1.0 + 1e-9);
}

}  // namespace vegetation_sim::scan

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {

/// Makes white noise in [-1, 1].
inline PlaneField noiseField(int size, std::uint64_t seed) {
  const Random random(seed);
  PlaneField out(size);
  for (std::size_t i = 0; i < out.u.size(); ++i) {
    out.u[i] = random.uniform(2 * i, -1.0, 1.0);
    out.v[i] = random.uniform(2 * i + 1, -1.0, 1.0);
  }
  return out;
}

/// Makes a smooth flow without divergence: waves of up to four periods across a square of 1 m, long
/// ones with a larger amplitude, rms 1 m/s. The flow is the same at every size.
inline PlaneField smoothFlow(int size, std::uint64_t seed) {
  const Random random(seed);
  PlaneField out(size);
  for (int kx = -4; kx <= 4; ++kx)
    for (int ky = -4; ky <= 4; ++ky) {
      if (kx * kx + ky * ky == 0 || kx * kx + ky * ky > 16) continue;
      const auto index = static_cast<std::uint64_t>((kx + 4) * 9 + ky + 4);
      const double strength = random.uniform(2 * index, -1.0, 1.0),
                   k = std::sqrt(kx * kx + ky * ky);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const double turns = static_cast<double>(kx * x + ky * y) / size;
          const double wave =
              strength * sinCosTurns(turns + random.uniform(2 * index + 1)).cos / (k * k);
          out.u[static_cast<std::size_t>(y * size + x)] += ky * wave;
          out.v[static_cast<std::size_t>(y * size + x)] -= kx * wave;
        }
    }
  const double scale = 1.0 / std::sqrt(2.0 * energyOf(out));
  for (double& value : out.u) value *= scale;
  for (double& value : out.v) value *= scale;
  return out;
}

/// Returns the norm of the difference over the norm of `want`.
inline double relativeError(const PlaneField& got, const PlaneField& want) {
  PlaneField difference = got;
  for (std::size_t i = 0; i < want.u.size(); ++i) {
    difference.u[i] -= want.u[i];
    difference.v[i] -= want.v[i];
  }
  return std::sqrt(energyOf(difference) / energyOf(want));
}

inline std::uint64_t hashOf(const PlaneField& field) {
  Hash hash;
  for (const double value : field.u) hash.add(value);
  for (const double value : field.v) hash.add(value);
  return hash.value();
}

}  // namespace vegetation_sim::canopy

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/noise.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {

double gradientNoise(std::uint64_t seed, double x) {
  const double cell = std::floor(x), u = x - cell;
  const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
  const Random random(seed);
  return gradientNoise(random.uniform(index, -1.0, 1.0), random.uniform(index + 1, -1.0, 1.0), u);
}

double gradientNoise(double left_slope, double right_slope, double u) {
  const double left = left_slope * u, right = right_slope * (u - 1.0);
  // the factor 2 makes the largest value 1
  return 2.0 * (left + (right - left) * smootherStep(u));
}

}  // namespace vegetation_sim

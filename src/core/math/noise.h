// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim {

/// Returns gradient noise in one dimension (Perlin 1985, quintic fade of 2002): in [-1, 1], zero at
/// whole numbers, zero mean, C2.
double gradientNoise(std::uint64_t seed, double x);

/// Returns the noise at the share u of a cell between whole numbers with these slopes.
double gradientNoise(double left_slope, double right_slope, double u);

}  // namespace vegetation_sim

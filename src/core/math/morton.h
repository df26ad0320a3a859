// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim {

/// Returns the place of a square of 1 m along a Morton curve through all landscapes: places that
/// are near along the curve are near each other on the ground.
std::uint64_t mortonKey(double x, double y);

}  // namespace vegetation_sim

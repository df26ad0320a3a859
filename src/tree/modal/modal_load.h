// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

/// Number of modes in a vector; rows are padded to multiples of it.
constexpr std::size_t MODES_ABREAST = 8;
inline std::size_t modalRow(std::size_t modes) {
  return (modes + MODES_ABREAST - 1) / MODES_ABREAST * MODES_ABREAST;
}

/// Computes out [row] += push [count][3][row] * velocity [count] in the widest instruction set of
/// the processor. The bits are the same in all of them: velocities in order, no fused operations.
void addPushes(const double* push, std::size_t row, const Vec3* velocity, std::size_t count,
               double* out);

}  // namespace vegetation_sim::forest

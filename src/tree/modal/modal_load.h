// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

/// Modes side by side: rows are filled up to whole ones of these.
constexpr std::size_t MODES_ABREAST = 8;
inline std::size_t modalRow(std::size_t modes) {
  return (modes + MODES_ABREAST - 1) / MODES_ABREAST * MODES_ABREAST;
}

/// out [row] += push [count][3][row] times velocity [count], in the widest instruction set of the
/// processor. The same bits on each of them: velocities in order, nothing fused.
void addPushes(const double* push, std::size_t row, const Vec3* velocity, std::size_t count,
               double* out);

}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

// Functions of math.h for many numbers at once, with the same bits, in the widest instruction set
// of the processor.

/// Sets sin[i] and cos[i] to those of angle[i]. The lists must not overlap.
void batchSinCos(const double* angle, std::size_t count, double* sin, double* cos);

/// Sets cos[i] to sinCosTurns(turns[i]).cos. `cos` may be `turns`.
void batchCosTurns(const double* turns, std::size_t count, double* cos);

/// Sets out[i] to arcTangent(y[i], x[i]). `out` may be `y` or `x`.
void batchArcTangent(const double* y, const double* x, std::size_t count, double* out);

}  // namespace vegetation_sim

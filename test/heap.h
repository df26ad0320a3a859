// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

/// Returns the bytes that operator new has allocated and that were not freed.
long liveBytes();
/// Returns the largest value of liveBytes() since the last call of restartPeak().
long peakBytes();
void restartPeak();
/// Returns how often operator new was called.
std::size_t allocationCount();

}  // namespace vegetation_sim

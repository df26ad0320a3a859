// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim::fuzz {

/// Limits of one input: processor time [s], and memory [bytes] for its size [bytes].
constexpr double MOST_SECONDS = 0.05;
constexpr long mostBytes(std::size_t input_size) {
  return 10 * static_cast<long>(input_size) + (64L << 20);
}

/// Returns the processor time of this process, all threads [s].
double processorSeconds();

}  // namespace vegetation_sim::fuzz

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "interleaved.h"

namespace vegetation_sim::bench {

/// Returns the bytes per second of a[i] = b[i] + s c[i] on arrays far larger than any cache.
inline double memoryBandwidth() {
  const std::size_t n = std::size_t{1} << 25;
  std::vector<float> a(n, 0.f), b(n, 1.f), c(n, 2.f);
  std::vector<Candidate> triad{{"triad", [&] {
                                  for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.f * c[i];
                                  asm volatile("" : : "r"(a.data()) : "memory");
                                }}};
  timeInterleaved(triad, 9);
  return 3.0 * sizeof(float) * static_cast<double>(n) / triad[0].seconds;
}

}  // namespace vegetation_sim::bench

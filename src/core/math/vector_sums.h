// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim::physics {

/// Returns a . b in eight interleaved sums, so that compilers may use vectors without changing a
/// bit.
inline double dotOf(const double* a, const double* b, std::size_t n) {
  double sum[8] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) sum[lane] += a[i + lane] * b[i + lane];
  for (std::size_t lane = 0; i < n; ++i, ++lane) sum[lane] += a[i] * b[i];
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

/// to += factor * from.
inline void addScaled(double factor, const double* from, std::size_t n, double* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] += factor * from[i];
}

/// Removes from x and y their components along the unit vector q, which is read once for both.
inline void makeOrthogonal(const double* q, std::size_t n, double* x, double* y) {
  constexpr std::size_t LANES = 4;
  double sx[LANES] = {0.0, 0.0, 0.0, 0.0}, sy[LANES] = {0.0, 0.0, 0.0, 0.0};
  std::size_t i = 0;
  for (; i + LANES <= n; i += LANES)
    for (std::size_t lane = 0; lane < LANES; ++lane) {
      sx[lane] += q[i + lane] * x[i + lane];
      sy[lane] += q[i + lane] * y[i + lane];
    }
  for (std::size_t lane = 0; i < n; ++i, ++lane) {
    sx[lane] += q[i] * x[i];
    sy[lane] += q[i] * y[i];
  }
  const double a = (sx[0] + sx[2]) + (sx[1] + sx[3]), b = (sy[0] + sy[2]) + (sy[1] + sy[3]);
  for (i = 0; i < n; ++i) {
    x[i] -= a * q[i];
    y[i] -= b * q[i];
  }
}

}  // namespace vegetation_sim::physics

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arithmetic of blades on one number; blade_lanes-inl.h has the same operations in the same order
// on vectors, so that both give the same bits.

namespace vegetation_sim::grass {

template <class T>
struct SineCosine {
  T sin, cos;
};

/// Returns sine and cosine of an angle in [0, 1.6] by Taylor series, with errors of 4e-8 and 4e-9.
template <class T>
SineCosine<T> sineCosine(T x) {
  const T u = x * x;
  T s = T(-1.0 / 39916800.0);
  s = s * u + T(1.0 / 362880.0);
  s = s * u - T(1.0 / 5040.0);
  s = s * u + T(1.0 / 120.0);
  s = s * u - T(1.0 / 6.0);
  T c = T(1.0 / 479001600.0);
  c = c * u - T(1.0 / 3628800.0);
  c = c * u + T(1.0 / 40320.0);
  c = c * u - T(1.0 / 720.0);
  c = c * u + T(1.0 / 24.0);
  c = c * u - T(0.5);
  return {x + x * (u * s), T(1) + u * c};
}

/// Returns sine and cosine of an angle in [0, 0.16], with errors of 5e-10 and 6e-12.
template <class T>
SineCosine<T> smallSineCosine(T x) {
  const T u = x * x;
  T s = T(1.0 / 120.0);
  s = s * u - T(1.0 / 6.0);
  T c = T(-1.0 / 720.0);
  c = c * u + T(1.0 / 24.0);
  c = c * u - T(0.5);
  return {x + x * (u * s), T(1) + u * c};
}

}  // namespace vegetation_sim::grass

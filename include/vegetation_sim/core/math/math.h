// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace vegetation_sim {

// The results have the same bits on every processor: they use only +, -, *, / and sqrt, which IEEE
// 754 fixes. The platform's own sin, pow and others differ between libraries and never compute
// state.

constexpr double PI = 3.14159265358979323846;

struct SinCos {
  double sin, cos;
};

/// Returns sine and cosine of `turns` full turns (1 turn = 2 pi). Error <= 2e-16 for |turns| <
/// 2^52.
SinCos sinCosTurns(double turns);

/// Returns sine and cosine of an angle [rad]. Error <= 4e-16 * max(1, |angle|).
SinCos sinCos(double angle);

/// Returns the angle of (x, y) in (-pi, pi] [rad], or 0 for (0, 0). Error <= 1e-15.
double arcTangent(double y, double x);

/// Returns the cube root for x >= 0. Relative error <= 4e-16.
double cubeRoot(double x);

/// Returns e^x: 0 below -745 and infinity above 709. Relative error <= 4e-16.
double exponential(double x);

/// Returns the natural logarithm of a finite x > 0. Error <= 4e-16 max(1, |ln x|).
double logarithm(double x);

/// Clamps to [0, 1].
inline double saturate(double x) {
  return std::min(1.0, std::max(0.0, x));
}

/// Returns 3x^2 - 2x^3 on [0, 1] and is constant outside: C1 (paper 1, section 4.3).
inline double smoothStep(double x) {
  const double u = saturate(x);
  return u * u * (3.0 - 2.0 * u);
}

/// Returns 6x^5 - 15x^4 + 10x^3 on [0, 1] and is constant outside: C2, as an envelope needs it
/// (E1).
inline double smootherStep(double x) {
  const double u = saturate(x);
  return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

/// Bounds a deviation: returns x up to `knee`, then approaches `limit` without reaching it, C2
/// (E16). Odd in x. Requires 0 < knee < limit.
double softLimit(double x, double knee, double limit);

}  // namespace vegetation_sim

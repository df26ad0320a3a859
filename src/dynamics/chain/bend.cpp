// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/bend.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::physics {
namespace {

// Below this angle squared, series are as exact as differences of sines, and faster.
constexpr double SMALL = 0.04;

Bend smallBend(double u) {
  const double h = 0.25 * u;  // of half the angle
  Bend out;
  out.s = 0.5 - h * (1.0 / 12.0 - h * (1.0 / 240.0 - h * (1.0 / 10080.0 - h * (1.0 / 725760.0))));
  out.w = 1.0 - h * (0.5 - h * (1.0 / 24.0 -
                                h * (1.0 / 720.0 - h * (1.0 / 40320.0 - h * (1.0 / 3628800.0)))));
  out.b = 2.0 * out.s * out.s;  // 1 - cos a = 2 sin^2(a / 2)
  out.c = 1.0 / 6.0 -
          u * (1.0 / 120.0 - u * (1.0 / 5040.0 - u * (1.0 / 362880.0 - u * (1.0 / 39916800.0))));
  out.db = -1.0 / 12.0 +
           u * (1.0 / 180.0 - u * (1.0 / 6720.0 - u * (1.0 / 453600.0 - u * (1.0 / 47900160.0))));
  out.dc =
      -1.0 / 60.0 +
      u * (1.0 / 1260.0 - u * (1.0 / 60480.0 - u * (1.0 / 4989600.0 - u * (1.0 / 622702080.0))));
  return out;
}

}  // namespace

Bend bendOf(const Vec2& q) {
  const double a2 = q.x() * q.x() + q.y() * q.y();
  if (a2 < SMALL) return smallBend(a2);
  const double a = std::sqrt(a2);
  const SinCos half = sinCos(0.5 * a);
  Bend out;
  out.w = half.cos;
  out.s = half.sin / a;
  out.b = 2.0 * out.s * out.s;
  const double whole = 2.0 * out.s * out.w;  // sin a / a
  out.c = (1.0 - whole) / a2;
  out.db = (whole - 2.0 * out.b) / a2;
  out.dc = (out.b - 3.0 * out.c) / a2;
  return out;
}

}  // namespace vegetation_sim::physics

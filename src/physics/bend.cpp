// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/bend.h"

#include <cmath>

#include "vegetation_sim/common/math.h"

namespace vegetation_sim::physics {
namespace {

// b = (1 - cos a) / a^2, c = (a - sin a) / a^3, and their derivatives over a.
struct Series {
  double b, c, db, dc;
};

// Up to this angle squared series are as exact as differences of sines, and faster.
constexpr double SMALL = 0.04;

Series seriesOf(double a2) {
  if (a2 < SMALL)
    return {0.5 - a2 * (1.0 / 24.0 - a2 * (1.0 / 720.0 - a2 * (1.0 / 40320.0 - a2 / 3628800.0))),
            1.0 / 6.0 -
                a2 * (1.0 / 120.0 - a2 * (1.0 / 5040.0 - a2 * (1.0 / 362880.0 - a2 / 39916800.0))),
            -1.0 / 12.0 +
                a2 * (1.0 / 180.0 - a2 * (1.0 / 6720.0 - a2 * (1.0 / 453600.0 - a2 / 47900160.0))),
            -1.0 / 60.0 + a2 * (1.0 / 1260.0 -
                                a2 * (1.0 / 60480.0 - a2 * (1.0 / 4989600.0 - a2 / 622702080.0)))};
  const double a = std::sqrt(a2);
  const SinCos s = sinCos(a);
  const double b = (1.0 - s.cos) / a2, c = (a - s.sin) / (a2 * a);
  return {b, c, (s.sin / a - 2.0 * b) / a2, (b - 3.0 * c) / a2};
}

}  // namespace

Quat bendRotation(const Vec2& q) {
  const double a2 = q.x() * q.x() + q.y() * q.y();
  if (a2 < SMALL) {
    const double h = 0.25 * a2;  // of half the angle
    const double s =
        0.5 - h * (1.0 / 12.0 - h * (1.0 / 240.0 - h * (1.0 / 10080.0 - h / 725760.0)));
    const double c =
        1.0 -
        h * (0.5 - h * (1.0 / 24.0 - h * (1.0 / 720.0 - h * (1.0 / 40320.0 - h / 3628800.0))));
    return {c, s * q.x(), s * q.y(), 0.0};
  }
  const double angle = std::sqrt(a2);
  const SinCos half = sinCos(0.5 * angle);
  const double s = half.sin / angle;
  return {half.cos, s * q.x(), s * q.y(), 0.0};
}

// The spin in the bent axes is (1 - b W + c W^2) times the rate of the rotation vector w, where W
// is the matrix of w x.
BendMotion bendMotion(const Vec2& q, const Vec2& rate) {
  const double x = q.x(), y = q.y(), rx = rate.x(), ry = rate.y();
  const Series s = seriesOf(x * x + y * y);
  const double swept = x * rx + y * ry;
  const double b = s.b, c = s.c, db = s.db * swept, dc = s.dc * swept;
  const double mixed = dc * x * y + c * (rx * y + x * ry);
  BendMotion out;
  out.first = Vec3(1.0 - c * y * y, c * x * y, b * y);
  out.second = Vec3(c * x * y, 1.0 - c * x * x, -b * x);
  out.bias = Vec3((-dc * y * y - 2.0 * c * y * ry) * rx + mixed * ry,
                  mixed * rx + (-dc * x * x - 2.0 * c * x * rx) * ry,
                  (db * y + b * ry) * rx - (db * x + b * rx) * ry);
  return out;
}

}  // namespace vegetation_sim::physics

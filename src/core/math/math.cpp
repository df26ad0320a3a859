// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/math.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace vegetation_sim {
namespace {

// Taylor series on |x| <= pi/4; the first omitted term is below 1e-18.
double sinePolynomial(double x) {
  const double x2 = x * x;
  double s = 1.0 / 355687428096000.0;
  s = s * x2 - 1.0 / 1307674368000.0;
  s = s * x2 + 1.0 / 6227020800.0;
  s = s * x2 - 1.0 / 39916800.0;
  s = s * x2 + 1.0 / 362880.0;
  s = s * x2 - 1.0 / 5040.0;
  s = s * x2 + 1.0 / 120.0;
  s = s * x2 - 1.0 / 6.0;
  return x + x * (x2 * s);
}

double cosinePolynomial(double x) {
  const double x2 = x * x;
  double c = 1.0 / 20922789888000.0;
  c = c * x2 - 1.0 / 87178291200.0;
  c = c * x2 + 1.0 / 479001600.0;
  c = c * x2 - 1.0 / 3628800.0;
  c = c * x2 + 1.0 / 40320.0;
  c = c * x2 - 1.0 / 720.0;
  c = c * x2 + 1.0 / 24.0;
  return 1.0 - 0.5 * x2 + x2 * x2 * c;
}

SinCos fromQuadrant(double x, int quadrant) {
  const double s = sinePolynomial(x), c = cosinePolynomial(x);
  switch (quadrant & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace

SinCos sinCosTurns(double turns) {
  // Subtracting the nearest whole turn makes the difference exact for small negative turns too.
  const double fraction = turns - std::floor(turns + 0.5);
  const double quarter = std::floor(fraction * 4.0 + 0.5);
  return fromQuadrant((fraction - quarter * 0.25) * (2.0 * PI), static_cast<int>(quarter));
}

SinCos sinCos(double angle) {
  // pi/2 in three parts (Cody and Waite): the products with a quadrant below 2^20 are exact.
  constexpr double HALF_PI_1 = 1.57079632673412561417e+00;
  constexpr double HALF_PI_2 = 6.07710050630396597660e-11;
  constexpr double HALF_PI_3 = 2.02226624879595063154e-21;
  if (!(std::fabs(angle) < 1e6)) return sinCosTurns(angle / (2.0 * PI));
  const double quadrant = std::floor(angle * (2.0 / PI) + 0.5);
  const double x = ((angle - quadrant * HALF_PI_1) - quadrant * HALF_PI_2) - quadrant * HALF_PI_3;
  return fromQuadrant(x, static_cast<int>(static_cast<std::int64_t>(quadrant) & 3));
}

double arcTangent(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  const double big = std::max(ax, ay);
  if (!(big > 0.0)) return 0.0;
  const double ratio = std::min(ax, ay) / big;
  const double scale = std::sqrt(1.0 + ratio * ratio);
  const double s = ratio / scale, c = 1.0 / scale;
  double angle = ratio * (PI / 4.0 + 0.273 * (1.0 - ratio));  // within 0.005 rad
  for (int i = 0; i < 2; ++i) {                               // each iteration cubes the error
    const SinCos guess = sinCos(angle);
    angle += s * guess.cos - c * guess.sin;
  }
  if (ay > ax) angle = PI / 2.0 - angle;
  if (x < 0.0) angle = PI - angle;
  return y < 0.0 ? -angle : angle;
}

double cubeRoot(double x) {
  if (!(x > 0.0)) return 0.0;
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = bits / 3 + 0x2A9F7893782DA1CEULL;  // a third of the exponent: within 5 %
  double r;
  std::memcpy(&r, &bits, sizeof r);
  for (int i = 0; i < 5; ++i) r -= (r - x / (r * r)) * (1.0 / 3.0);
  return r;
}

double exponential(double x) {
  // ln 2 in two parts (Cody and Waite): the product with a whole number below 2^21 is exact.
  constexpr double LN2_1 = 6.93147180369123816490e-01, LN2_2 = 1.90821492927058770002e-10;
  if (x < -745.2) return 0.0;
  if (!(x <= 709.8)) return x + std::numeric_limits<double>::infinity();  // NaN stays NaN
  const double power = std::floor(x * (1.0 / 0.69314718055994530942) + 0.5);
  const double high = x - power * LN2_1, low = power * LN2_2, r = high - low;
  // Taylor series on |r| <= ln 2 / 2; the first omitted term is below 1e-17.
  double s = 1.0 / 6227020800.0;
  for (const double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0,
                                 720.0, 120.0, 24.0, 6.0, 2.0})
    s = s * r + 1.0 / factorial;
  return std::ldexp(1.0 + (high + (r * r * s - low)), static_cast<int>(power));
}

double logarithm(double x) {
  constexpr double LN2_1 = 6.93147180369123816490e-01, LN2_2 = 1.90821492927058770002e-10;
  int power = 0;
  double m = std::frexp(x, &power);  // in [0.5, 1)
  if (m < 0.70710678118654752440) m *= 2.0, --power;
  // ln m = 2 artanh s; the series in s^2 <= 0.0295 omits less than 1e-17.
  const double s = (m - 1.0) / (m + 1.0), square = s * s;
  double sum = 0.0;
  for (const double n : {21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0})
    sum = square * (1.0 / n + sum);
  return power * LN2_1 + (2.0 * s * (1.0 + sum) + power * LN2_2);
}

double softLimit(double x, double knee, double limit) {
  const double magnitude = std::fabs(x);
  if (magnitude <= knee) return x;
  const double room = limit - knee, excess = (magnitude - knee) / room;
  const double bounded = knee + room * (excess / std::sqrt(1.0 + excess * excess));
  return x < 0.0 ? -bounded : bounded;
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

// Bounds that math.h states, plus half a unit in the last place for the reference's own rounding.
constexpr double HALF_ULP = 1.2e-16;

/// Returns the sine of turns in extended precision: a 64-bit mantissa, so that its own error does
/// not count.
long double referenceSine(double turns) {
  const long double fraction = static_cast<long double>(turns) - std::floor(turns);
  return std::sin(2.0L * 3.14159265358979323846264338327950288L * fraction);
}

TEST(SinCosTurns, IsWithinItsBoundForAnySizeOfTurns) {
  const Random random(1);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double size = std::pow(2.0, random.uniform(2 * i, -20.0, 51.0));
    const double turns = size * random.uniform(2 * i + 1, -1.0, 1.0);
    const SinCos got = sinCosTurns(turns);
    ASSERT_NEAR(got.sin, static_cast<double>(referenceSine(turns)), 2e-16 + HALF_ULP) << turns;
    ASSERT_NEAR(got.sin * got.sin + got.cos * got.cos, 1.0, 1e-15) << turns;
  }
}

TEST(Exponential, IsWithinItsBoundOverItsWholeRange) {
  const Random random(3);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double x = random.uniform(i, -700.0, 700.0) * (i % 2 ? 1.0 : 1e-3);
    const double want = static_cast<double>(std::exp(static_cast<long double>(x)));
    ASSERT_NEAR(exponential(x) / want, 1.0, 4e-16) << x;
  }
}

TEST(Exponential, EndsInZeroAndInfinity) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-1e300), 0.0);
  EXPECT_GT(exponential(-740.0), 0.0);  // denormal, but not zero
  EXPECT_TRUE(std::isinf(exponential(1e300)));
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
}

TEST(Math, LogarithmIsThatOfTheLibrary) {
  for (const double x :
       {1e-300, 1e-9, 0.3, 0.7071, 0.7072, 0.999999, 1.0, 1.000001, 1.5, 2.0, 9e8}) {
    const double want = std::log(x);
    ASSERT_NEAR(logarithm(x), want, 4e-16 * std::max(1.0, std::fabs(want))) << x;
  }
  EXPECT_EQ(logarithm(1.0), 0.0);
  EXPECT_NEAR(logarithm(exponential(3.0)), 3.0, 1e-15);
}

TEST(SinCosTurns, IsExactAtQuarterTurns) {
  EXPECT_EQ(sinCosTurns(0.0).sin, 0.0);
  EXPECT_EQ(sinCosTurns(0.25).sin, 1.0);
  EXPECT_EQ(sinCosTurns(0.25).cos, 0.0);
  EXPECT_EQ(sinCosTurns(1e15 + 0.5).cos, -1.0);
  EXPECT_EQ(sinCosTurns(-0.25).sin, -1.0);
}

TEST(SinCos, IsWithinItsBound) {
  const Random random(2);
  for (std::uint64_t i = 0; i < 40000; ++i) {
    const double size = std::pow(10.0, random.uniform(2 * i, -8.0, 9.0));
    const double angle = size * random.uniform(2 * i + 1, -1.0, 1.0);
    const double bound = 4e-16 * std::max(1.0, std::fabs(angle)) + HALF_ULP;
    const SinCos got = sinCos(angle);
    ASSERT_NEAR(got.sin, std::sin(angle), bound) << angle;
    ASSERT_NEAR(got.cos, std::cos(angle), bound) << angle;
  }
}

TEST(SinCos, KeepsItsPrecisionBelowAThousandTurns) {
  for (int i = -6000; i <= 6000; ++i) {
    const double angle = i * 1.000123;
    ASSERT_NEAR(sinCos(angle).sin, std::sin(angle), 4e-16) << angle;
    ASSERT_NEAR(sinCos(angle).cos, std::cos(angle), 4e-16) << angle;
  }
}

TEST(ArcTangent, IsWithinItsBoundInAllOctants) {
  const Random random(3);
  for (std::uint64_t i = 0; i < 40000; ++i) {
    const double y = std::pow(10.0, random.uniform(4 * i, -9.0, 9.0)) *
                     (random.uniform(4 * i + 1) < 0.5 ? -1.0 : 1.0);
    const double x = std::pow(10.0, random.uniform(4 * i + 2, -9.0, 9.0)) *
                     (random.uniform(4 * i + 3) < 0.5 ? -1.0 : 1.0);
    ASSERT_NEAR(arcTangent(y, x), std::atan2(y, x), 1e-15) << y << ' ' << x;
  }
}

TEST(ArcTangent, IsRightOnAxesAndDiagonals) {
  EXPECT_EQ(arcTangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arcTangent(0.0, 2.0), 0.0);
  EXPECT_EQ(arcTangent(2.0, 0.0), PI / 2.0);
  EXPECT_EQ(arcTangent(-2.0, 0.0), -PI / 2.0);
  EXPECT_EQ(arcTangent(0.0, -2.0), PI);
  for (const double y : {-1.0, 1.0})
    for (const double x : {-1.0, 1.0}) EXPECT_NEAR(arcTangent(y, x), std::atan2(y, x), 1e-15);
}

TEST(CubeRoot, IsWithinItsBound) {
  const Random random(4);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double x = std::pow(10.0, random.uniform(i, -200.0, 200.0));
    const long double root = cubeRoot(x);
    // The cube has three times the root's relative error (std::cbrt itself is off by 5e-16).
    ASSERT_NEAR(static_cast<double>(root * root * root / x - 1.0L), 0.0, 3.0 * 4e-16) << x;
  }
  EXPECT_EQ(cubeRoot(0.0), 0.0);
  EXPECT_EQ(cubeRoot(27.0), 3.0);
}

TEST(SmoothStep, HasItsReferenceValuesAndIsFlatOutside) {
  EXPECT_EQ(smoothStep(0.25), 0.15625);
  EXPECT_EQ(smoothStep(0.5), 0.5);
  EXPECT_EQ(smoothStep(0.75), 0.84375);
  EXPECT_EQ(smoothStep(-3.0), 0.0);
  EXPECT_EQ(smoothStep(3.0), 1.0);
}

TEST(SmootherStep, HasItsReferenceValuesAndIsFlatOutside) {
  EXPECT_EQ(smootherStep(0.25), 0.103515625);
  EXPECT_EQ(smootherStep(0.5), 0.5);
  EXPECT_EQ(smootherStep(0.75), 0.896484375);
  EXPECT_EQ(smootherStep(-3.0), 0.0);
  EXPECT_EQ(smootherStep(3.0), 1.0);
}

double slope(double (*f)(double), double x, double h) {
  return (f(x + h) - f(x - h)) / (2.0 * h);
}

double curvature(double (*f)(double), double x, double h) {
  return (f(x + h) - 2.0 * f(x) + f(x - h)) / (h * h);
}

// An envelope of forces needs two derivatives.
TEST(SmootherStep, StartsAndEndsWithoutSlopeOrCurvature) {
  constexpr double H = 1e-4;
  for (const double x : {0.0, 1.0}) {
    EXPECT_NEAR(slope(smootherStep, x, H), 0.0, 1e-7);
    EXPECT_NEAR(curvature(smootherStep, x, H), 0.0, 1e-2);
    EXPECT_GT(std::fabs(curvature(smoothStep, x, H)), 2.0);  // the paper's step jumps by 6
  }
}

constexpr double KNEE = 0.6, LIMIT = 1.5;
double limited(double x) {
  return softLimit(x, KNEE, LIMIT);
}

// E16: the deviation is bounded for any sum.
TEST(SoftLimit, IsBoundedForAnyInput) {
  for (const double x : {1.0, 10.0, 1e6, 1e300}) {
    EXPECT_LE(limited(x), LIMIT);
    EXPECT_GE(limited(-x), -LIMIT);
  }
  EXPECT_GT(limited(1e6), LIMIT - 1e-6);
}

// E16
TEST(SoftLimit, IsTheIdentityBelowTheKneeOddAndRising) {
  double before = -LIMIT;
  for (int i = -4000; i <= 4000; ++i) {
    const double x = 0.001 * i;
    if (std::fabs(x) <= KNEE) {
      ASSERT_EQ(limited(x), x);
    }
    ASSERT_EQ(limited(-x), -limited(x));
    ASSERT_GT(limited(x), before);
    before = limited(x);
  }
}

// E16
TEST(SoftLimit, HasNoKinkAtTheKnee) {
  constexpr double H = 1e-4;
  for (const double x : {-KNEE, KNEE}) {
    EXPECT_NEAR(slope(limited, x, H), 1.0, 1e-6);
    // A third derivative of 3 / room^2 times H; a C1 law would show a jump of order 1.
    EXPECT_NEAR(curvature(limited, x, H), 0.0, 2e-3);
  }
}

}  // namespace
}  // namespace vegetation_sim

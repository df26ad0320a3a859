// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim {
namespace {

// S1-12: equal seeds give equal noise, other seeds other noise.
TEST(GradientNoise, IsAFunctionOfItsSeed) {
  EXPECT_EQ(gradientNoise(3, 1.37), gradientNoise(3, 1.37));
  EXPECT_NE(gradientNoise(3, 1.37), gradientNoise(4, 1.37));
}

// S1-12
TEST(GradientNoise, StaysInItsBoundsAndComesNearThem) {
  double largest = 0.0;
  for (int i = 0; i < 400000; ++i) {
    const double n = gradientNoise(1, -1000.0 + 0.005 * i);
    ASSERT_LE(std::fabs(n), 1.0);
    largest = std::max(largest, std::fabs(n));
  }
  EXPECT_GT(largest, 0.8);
}

// S1-12
TEST(GradientNoise, HasZeroMean) {
  constexpr int CELLS = 20000, PER_CELL = 8;
  double sum = 0.0, squares = 0.0;
  for (int cell = 0; cell < CELLS; ++cell) {
    double mean = 0.0;
    for (int i = 0; i < PER_CELL; ++i)
      mean += gradientNoise(2, cell + (i + 0.5) / PER_CELL) / PER_CELL;
    sum += mean;
    squares += mean * mean;
  }
  // Five standard errors; neighbouring cells share a gradient, hence the factor 2.
  EXPECT_LT(std::fabs(sum / CELLS), 5.0 * std::sqrt(2.0 * squares) / CELLS);
}

// S1-12
TEST(GradientNoise, IsZeroAtWholeNumbersAndSmoothAcrossThem) {
  constexpr double H = 1e-4;
  for (int i = -50; i <= 50; ++i) {
    ASSERT_EQ(gradientNoise(5, i), 0.0);
    const auto slopeAt = [](double x) {
      return (gradientNoise(5, x + H) - gradientNoise(5, x - H)) / (2.0 * H);
    };
    const auto curvatureAt = [&](double x) {
      return (slopeAt(x + H) - slopeAt(x - H)) / (2.0 * H);
    };
    // Third derivatives are below 250, so that over 8 H a smooth curvature changes by less than
    // 0.2.
    ASSERT_NEAR(slopeAt(i - 4.0 * H), slopeAt(i + 4.0 * H), 1e-2);
    ASSERT_NEAR(curvatureAt(i - 4.0 * H), curvatureAt(i + 4.0 * H), 0.2);
  }
}

TEST(GradientNoise, WorksFarFromZero) {
  for (const double x : {1e9 + 0.25, -1e9 - 0.25, 1e12 + 0.5})
    EXPECT_LE(std::fabs(gradientNoise(6, x)), 1.0);
  EXPECT_NE(gradientNoise(6, 1e9 + 0.25), gradientNoise(6, 1e9 + 1.25));
}

}  // namespace
}  // namespace vegetation_sim

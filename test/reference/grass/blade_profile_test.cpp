// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/blade_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {
namespace {

template <class T>
double lengthOf(const Profile<T>& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < LINKS; ++i)
    sum += std::hypot(double{p.reach[i + 1]} - p.reach[i], double{p.rise[i + 1]} - p.rise[i]);
  return sum;
}

// Length of the paper's curve with its tip at abscissa x of a blade of length 1, 20 000 chords.
double paperLength(double x) {
  const double z = loweredTip(1.0, x);
  double sum = 0.0;
  PlanePoint<double> before = hermitePoint(1.0, x, z, 0.0);
  for (int i = 1; i <= 20000; ++i) {
    const PlanePoint<double> now = hermitePoint(1.0, x, z, i / 20000.0);
    sum += std::hypot(now.reach - before.reach, now.rise - before.rise);
    before = now;
  }
  return sum;
}

// S2-09, E14: the default keeps its length at any bend up to 90 degrees, hinge and arc alike.
TEST(Blade, KeepsItsLengthAtAnyBend) {
  for (double hinge = 0.0; hinge <= PI / 2; hinge += 0.05)
    for (double arc = 0.0; hinge + arc <= PI / 2; arc += 0.05) {
      EXPECT_NEAR(lengthOf(bladeProfile(1.0, hinge, arc, BladeModel::ARC)), 1.0, 1e-7);
      EXPECT_NEAR(lengthOf(bladeProfile(1.f, static_cast<float>(hinge), static_cast<float>(arc),
                                        BladeModel::ARC)),
                  1.0, 1e-5);
    }
}

// E14: the paper's curve grows by 0.7 % at x = 0.2, 2.6 % at 0.4, 5.8 % at 0.6, 10.4 % at 0.8.
TEST(Blade, OfThePaperGrowsAsItBends) {
  EXPECT_NEAR(paperLength(0.0), 1.0, 1e-9);
  EXPECT_NEAR(paperLength(0.2), 1.007, 5e-4);
  EXPECT_NEAR(paperLength(0.4), 1.026, 5e-4);
  EXPECT_NEAR(paperLength(0.6), 1.058, 5e-4);
  EXPECT_NEAR(paperLength(0.8), 1.104, 5e-4);
}

// S2-09: the printed cure holds the length within 11 % over x / h in [0, 0.8]; the default 10 000
// times better, in the same table.
TEST(Blade, ErrorsOfBothModelsStandInOneTable) {
  for (double x = 0.0; x <= 0.8; x += 0.1) {
    const double arc = 2.0 * arcTangent(x, loweredTip(1.0, x));  // its chord points at that tip
    EXPECT_LT(paperLength(x) - 1.0, 0.11);
    if (arc <= BEND_LIMIT) {
      EXPECT_NEAR(lengthOf(bladeProfile(1.0, 0.0, arc, BladeModel::ARC)), 1.0, 1e-7);
    }
  }
}

// S2-07: base and tip, tangents at both ends.
TEST(Blade, HermiteCurveHasItsEndsAndTangents) {
  const double x = 0.5, z = loweredTip(0.8, 0.5), step = 1e-7;
  const auto start = hermitePoint(0.8, x, z, 0.0), end = hermitePoint(0.8, x, z, 1.0);
  EXPECT_EQ(start.reach, 0.0);
  EXPECT_EQ(start.rise, 0.0);
  EXPECT_DOUBLE_EQ(end.reach, x);
  EXPECT_DOUBLE_EQ(end.rise, z);
  const auto after = hermitePoint(0.8, x, z, step), before = hermitePoint(0.8, x, z, 1.0 - step);
  EXPECT_NEAR(after.reach / step, 0.0, 1e-5);
  EXPECT_NEAR(after.rise / step, 0.8, 1e-5);
  EXPECT_NEAR((end.reach - before.reach) / step, 2.0 * x, 1e-5);
  EXPECT_NEAR((end.rise - before.rise) / step, 2.0 * z - 0.8, 1e-5);
}

// S2-07: the profile of the paper's model lies on its curve.
TEST(Blade, OfThePaperIsSampledOnItsCurve) {
  const auto profile = bladeProfile(0.8, 0.2, 0.9, BladeModel::PAPER);
  const double x = 0.8 * std::sin(0.2 + 0.45);
  for (int i = 0; i < POINTS; ++i) {
    const auto point = hermitePoint(0.8, x, loweredTip(0.8, x), i / double{LINKS});
    EXPECT_NEAR(profile.reach[static_cast<std::size_t>(i)], point.reach, 1e-7);
    EXPECT_NEAR(profile.rise[static_cast<std::size_t>(i)], point.rise, 1e-7);
  }
}

// S2-26: a crushed blade is almost horizontal, in both models, and no point is below the root.
TEST(Blade, CrushedIsWithinTenDegreesOfTheGroundAndNeverBelow) {
  for (const BladeModel model : {BladeModel::ARC, BladeModel::PAPER}) {
    const auto flat = bladeProfile(0.4, BEND_LIMIT, 0.0, model);
    const double elevation = arcTangent(flat.rise[LINKS], flat.reach[LINKS]);
    EXPECT_LT(elevation, 10.0 * PI / 180.0);
    EXPECT_GT(elevation, 0.0);
  }
  for (float hinge = 0.f; hinge <= 1.5f; hinge += 0.01f)
    for (float arc = 0.f; hinge + arc <= 1.5f; arc += 0.01f) {
      const auto p = bladeProfile(0.4f, hinge, arc, BladeModel::ARC);
      for (std::size_t i = 0; i < POINTS; ++i) {
        ASSERT_GE(p.rise[i], 0.f);
        ASSERT_LE(p.rise[i], 0.4f * 1.00001f);
        ASSERT_LE(p.reach[i], 0.4f * 1.00001f);
      }
      for (std::size_t i = 0; i < LINKS; ++i) ASSERT_GT(p.rise[i + 1], p.rise[i]);
    }
}

TEST(Blade, UprightStandsStraight) {
  const auto p = bladeProfile(0.5, 0.0, 0.0, BladeModel::ARC);
  for (std::size_t i = 0; i < POINTS; ++i) {
    EXPECT_EQ(p.reach[i], 0.0);
    EXPECT_NEAR(p.rise[i], 0.1 * static_cast<double>(i), 1e-15);
  }
}

}  // namespace
}  // namespace vegetation_sim::grass

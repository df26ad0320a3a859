// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "reference/grass/tread_field.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

// The integral that the closed form solves: Gauss-Legendre of 5 points on 4 000 pieces.
double quadrature(const Point& p, const Point& p0, const Point& p1, double eps) {
  const double nodes[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                          -0.9061798459386640};
  const double weights[] = {128.0 / 225.0, 0.4786286704993665, 0.4786286704993665,
                            0.2369268850561891, 0.2369268850561891};
  constexpr int PIECES = 4000;
  const double c = std::hypot(p1.x - p0.x, p1.y - p0.y);
  double sum = 0.0;
  for (int i = 0; i < PIECES; ++i)
    for (int k = 0; k < 5; ++k) {
      const double s = (i + 0.5 + 0.5 * nodes[k]) / PIECES;
      const double x = p0.x + s * (p1.x - p0.x) - p.x, y = p0.y + s * (p1.y - p0.y) - p.y;
      const double r = std::sqrt(x * x + y * y + eps * eps);
      sum += 0.5 * weights[k] * c / PIECES / (r * r * r);
    }
  return sum;
}

struct Case {
  Point p, p0, p1;
};
Case randomCase(int i) {
  const Random random(static_cast<std::uint64_t>(i));
  const auto point = [&](std::uint64_t k) {
    return Point{random.uniform(2 * k, -2.0, 2.0), random.uniform(2 * k + 1, -2.0, 2.0)};
  };
  return {point(0), point(1), point(2)};
}

// S2-22, E5: the value of the requirement; the printed unsigned reading would give 0 here.
TEST(TreadField, HasTheValueOfTheRequirement) {
  EXPECT_NEAR(treadField({0, 1}, {-1, 0}, {1, 0}, 0.0), std::sqrt(2.0), 1e-15);
}

// E5: closed form against the integral.
TEST(TreadField, IsTheIntegralOfItsKernel) {
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Case c = randomCase(i);
    for (const double eps : {0.1, 0.5}) {
      const double exact = quadrature(c.p, c.p0, c.p1, eps);
      ASSERT_NEAR(treadField(c.p, c.p0, c.p1, eps) / exact, 1.0, 1e-9) << i;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 600);
}

// E5: beyond an end the line itself is harmless; as printed the formula fails there.
TEST(TreadField, IsRightNearTheExtensionOfTheSegment) {
  EXPECT_NEAR(treadField({0, 0}, {0.5, 0}, {1.5, 0}, 0.0), 16.0 / 9.0, 1e-14);
  EXPECT_NEAR(treadField({0, 1e-9}, {0.5, 0}, {1.5, 0}, 0.0), 16.0 / 9.0, 1e-12);
  EXPECT_NEAR(treadField({2, 1e-9}, {0.5, 0}, {1.5, 0}, 0.0), (4.0 - 1.0 / 2.25) / 2.0, 1e-12);
  const double printed = treadFieldPrinted({0, 1e-9}, {0.5, 0}, {1.5, 0});
  EXPECT_FALSE(std::fabs(printed - 16.0 / 9.0) < 1.0);
}

// E5: with a radius it is finite on the track itself.
TEST(TreadField, IsFiniteOnTheTrackWithARadius) {
  EXPECT_NEAR(treadField({0, 0}, {-0.4, 0}, {0.7, 0}, 0.1), 196.0092, 1e-4);
  EXPECT_NEAR(treadField({-0.4, 0}, {-0.4, 0}, {0.7, 0}, 0.1),
              quadrature({-0.4, 0}, {-0.4, 0}, {0.7, 0}, 0.1), 1e-6);
  EXPECT_TRUE(std::isinf(treadField({0, 0}, {-0.4, 0}, {0.7, 0}, 0.0)));
  EXPECT_EQ(treadField({0, 0}, {0.4, 0}, {0.4, 0}, 0.1), 0.0);
}

// E5: away from the line the printed form is the same.
TEST(TreadField, AgreesWithThePrintedFormInGeneral) {
  for (int i = 0; i < 300; ++i) {
    const Case c = randomCase(i);
    const double exact = treadField(c.p, c.p0, c.p1, 0.0);
    if (exact > 1e3) continue;  // so near to the line that the printed form loses digits
    EXPECT_NEAR(treadFieldPrinted(c.p, c.p0, c.p1) / exact, 1.0, 1e-7) << i;
  }
}

// S2-22: the field of a segment is the sum of the fields of its parts.
TEST(TreadField, IsAdditiveOverParts) {
  for (int i = 0; i < 100; ++i) {
    const Case c = randomCase(i);
    const double whole = treadField(c.p, c.p0, c.p1, 0.05);
    for (const int parts : {10, 1000}) {
      double sum = 0.0;
      const auto at = [&](int k) {
        const double s = static_cast<double>(k) / parts;
        return Point{c.p0.x + s * (c.p1.x - c.p0.x), c.p0.y + s * (c.p1.y - c.p0.y)};
      };
      for (int k = 0; k < parts; ++k) sum += treadField(c.p, at(k), at(k + 1), 0.05);
      EXPECT_NEAR(sum / whole, 1.0, 1e-12 * parts) << i;  // rounding of the ends of each part
    }
  }
}

TEST(TreadField, HasTheSymmetriesOfItsIntegral) {
  for (int i = 0; i < 200; ++i) {
    const Case c = randomCase(i);
    const double f = treadField(c.p, c.p0, c.p1, 0.0);
    EXPECT_NEAR(treadField(c.p, c.p1, c.p0, 0.0) / f, 1.0, 1e-12);
    const auto scaled = [](const Point& p) { return Point{3.0 * p.x, 3.0 * p.y}; };
    EXPECT_NEAR(9.0 * treadField(scaled(c.p), scaled(c.p0), scaled(c.p1), 0.0) / f, 1.0, 1e-11);
    const auto turned = [](const Point& p) {
      return Point{0.6 * p.x - 0.8 * p.y + 5.0, 0.8 * p.x + 0.6 * p.y - 7.0};
    };
    EXPECT_NEAR(treadField(turned(c.p), turned(c.p0), turned(c.p1), 0.0) / f, 1.0, 1e-9);
    const double away = std::hypot(c.p0.x - c.p.x, c.p0.y - c.p.y);
    EXPECT_GT(f, 0.0) << away;
  }
}

// S2-25: right of the track to the right and forward, left to the left and forward.
TEST(TreadVector, PushesAsideAndForward) {
  const Point left = treadVector({0.5, 1}, {0, 0}, {1, 0}, 2.0);
  const Point right = treadVector({0.5, -1}, {0, 0}, {1, 0}, 2.0);
  const Point on = treadVector({0.5, 0}, {0, 0}, {1, 0}, 2.0);
  EXPECT_EQ(left.x, 2.0);
  EXPECT_EQ(left.y, 2.0);
  EXPECT_EQ(right.x, 2.0);
  EXPECT_EQ(right.y, -2.0);
  EXPECT_EQ(on.x, 2.0);
  EXPECT_EQ(on.y, 0.0);
  EXPECT_NEAR(std::hypot(left.x, left.y), std::sqrt(2.0) * 2.0, 1e-15);
}

// S2-22: the finite radius of influence, value of the reference.
TEST(CompactField, OnAnEndlessTrackHasTheReferencesValue) {
  EXPECT_NEAR(CompactField::ofEndlessTrack(0.0, 0.6, 0.1), 191.946925719, 1e-9);
}

TEST(CompactField, IsTheIntegralOfItsKernelWithinItsReach) {
  const double reach = 0.6, eps = 0.1, edge = std::pow(reach * reach + eps * eps, -1.5);
  for (int i = 0; i < 200; ++i) {
    const Case c = randomCase(i);
    const Point p{0.3 * c.p.x, 0.3 * c.p.y};
    const double length = std::hypot(c.p1.x - c.p0.x, c.p1.y - c.p0.y);
    constexpr int PIECES = 200000;
    double sum = 0.0;
    for (int k = 0; k < PIECES; ++k) {
      const double s = (k + 0.5) / PIECES;
      const double x = c.p0.x + s * (c.p1.x - c.p0.x) - p.x;
      const double y = c.p0.y + s * (c.p1.y - c.p0.y) - p.y;
      const double square = x * x + y * y;
      if (square < reach * reach)
        sum += (std::pow(square + eps * eps, -1.5) - edge) * length / PIECES;
    }
    const double field = CompactField(c.p0, c.p1, reach, eps).fieldAt(p);
    ASSERT_NEAR(field, sum, 1e-6 * (1.0 + sum)) << i;  // midpoints, and ends cut within a piece
  }
}

// S2-22: nothing from the reach on, and nothing jumps there.
TEST(CompactField, EndsSmoothlyAtItsReach) {
  const CompactField field({0, 0}, {1, 0}, 0.5, 0.1);
  EXPECT_EQ(field.fieldAt(Point{0.5, 0.5}), 0.0);
  EXPECT_EQ(field.fieldAt(Point{1.51, 0.0}), 0.0);
  EXPECT_NEAR(field.fieldAt(Point{0.5, 0.4999}), 0.0, 1e-3);
  EXPECT_NEAR(field.fieldAt(Point{1.4999, 0.0}), 0.0, 1e-3);
  double before = field.fieldAt(Point{0.5, 0.0});
  for (double y = 0.01; y <= 0.5; y += 0.01) {
    const double now = field.fieldAt(Point{0.5, y});
    EXPECT_LT(now, before);
    before = now;
  }
}

// S2-23: the same 4 m in 1 to 16 384 parts.
TEST(CompactField, IsTheSameInAnyNumberOfParts) {
  for (const Point p : {Point{1.3, 0.2}, Point{2.0, 0.0}, Point{0.1, -0.4}, Point{4.2, 0.1}}) {
    const double whole = CompactField({0, 0}, {4, 0}, 0.6, 0.1).fieldAt(p);
    for (const int parts : {16, 1024, 16384}) {
      double sum = 0.0;
      for (int k = 0; k < parts; ++k)
        sum += CompactField({4.0 * k / parts, 0}, {4.0 * (k + 1) / parts, 0}, 0.6, 0.1).fieldAt(p);
      EXPECT_NEAR(sum / whole, 1.0, 1e-10) << parts;
    }
  }
}

TEST(CompactField, KnowsDistanceAndSide) {
  const CompactField field({0, 0}, {2, 0}, 0.5, 0.1);
  EXPECT_EQ(field.placeOf({1.0, 0.3}).side, 0.3);
  EXPECT_EQ(field.placeOf({1.0, -0.3}).side, -0.3);
  EXPECT_NEAR(field.placeOf({2.3, 0.4}).square_distance, 0.25, 1e-15);
  EXPECT_NEAR(field.placeOf({-0.3, 0.0}).square_distance, 0.09, 1e-15);
  EXPECT_EQ(CompactField({1, 1}, {1, 1}, 0.5, 0.1).fieldAt(Point{1, 1.2}), 0.0);
}

TEST(TreadLaw, RejectsBadValuesWithTheirNames) {
  Faults faults;
  TreadLaw law;
  law.radius = 0.3;
  law.softness = 0.0;
  law.recovery = std::nan("");
  check(law, "wheel: ", faults);
  EXPECT_EQ(faults.text(),
            "wheel: softness = 0 m is outside 0.001 to 5 m\n"
            "wheel: recovery = nan s is not finite, allowed is 0 to 1e+09 s\n"
            "wheel: reach = 0.350000 m is below 1.5 times radius = 0.300000 m");
}

}  // namespace
}  // namespace vegetation_sim::grass

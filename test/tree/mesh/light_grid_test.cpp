// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/light_grid.h"

#include <gtest/gtest.h>

#include <limits>

namespace vegetation_sim::forest {
namespace {

constexpr double CELL = 0.5;

// A layer of leaves over the square |x|, |y| < 4, of leaf area 2 at z = 6.
LightGrid roofed(const Vec3& to_sun) {
  LightGrid out(Vec3(-12.0, -12.0, 0.0), Vec3(12.0, 12.0, 8.0), CELL);
  for (double x = -4.0; x < 4.0; x += CELL)
    for (double y = -4.0; y < 4.0; y += CELL) out.addLeaf(Vec3(x, y, 6.0), 2.0 * CELL * CELL);
  out.cast(to_sun);
  return out;
}

TEST(LightGrid, OpenAirIsFullyLit) {
  LightGrid grid(Vec3(0, 0, 0), Vec3(10, 10, 10), 1.0);
  EXPECT_EQ(grid.sun(Vec3(5, 5, 0)), 1.0);
  grid.cast(Vec3(0.3, 0.2, 1.0));
  EXPECT_NEAR(grid.sun(Vec3(5, 5, 0)), 1.0, 1e-5);
  EXPECT_NEAR(grid.sky(Vec3(5, 5, 0)), 1.0, 1e-5);
}

// Beer's law: leaf area 2 at an extinction of 0.4 lets exp(-0.8) = 0.45 pass straight down.
TEST(LightGrid, LeavesTakeLightByBeersLaw) {
  const LightGrid grid = roofed(Vec3(0, 0, 1));
  EXPECT_NEAR(grid.sun(Vec3(0, 0, 1)), 0.45, 0.03);  // the law's series to its second order
  EXPECT_NEAR(grid.sun(Vec3(0, 0, 7.5)), 1.0, 1e-5);
  EXPECT_NEAR(grid.sun(Vec3(9, 9, 1)), 1.0, 1e-5);
}

TEST(LightGrid, ShadowFallsAwayFromTheSun) {
  const LightGrid grid = roofed(Vec3(1, 0, 1));  // from the east, 45 degrees high
  EXPECT_LT(grid.sun(Vec3(-5.0, 0, 1)), 0.5);
  EXPECT_NEAR(grid.sun(Vec3(1.0, 0, 1)), 1.0, 0.02);
}

TEST(LightGrid, SkyComesInFromTheSides) {
  const LightGrid grid = roofed(Vec3(0, 0, 1));
  EXPECT_LT(grid.sky(Vec3(0, 0, 5)), grid.sky(Vec3(0, 0, 1)));
  EXPECT_LT(grid.sky(Vec3(0, 0, 1)), grid.sky(Vec3(8, 0, 1)));
}

TEST(LightGrid, MoreLeavesAreDarker) {
  double before = 1.1;
  for (const double area : {0.0, 1.0, 3.0, 9.0, 100.0}) {
    LightGrid grid(Vec3(0, 0, 0), Vec3(4, 4, 4), 1.0);
    grid.addLeaf(Vec3(2, 2, 3), area);
    grid.cast(Vec3(0, 0, 1));
    EXPECT_LT(grid.sun(Vec3(2, 2, 1)), before);
    EXPECT_GE(grid.sun(Vec3(2, 2, 1)), 0.0);
    before = grid.sun(Vec3(2, 2, 1));
  }
}

TEST(LightGrid, WhatIsNoPlaceIsLitAndHurtsNothing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  LightGrid grid = roofed(Vec3(0, 0, 1));
  grid.addLeaf(Vec3(none, 0, 0), 1.0);
  grid.addLeaf(Vec3(1e9, 0, 0), 1.0);
  EXPECT_EQ(grid.sun(Vec3(none, 0, 0)), 1.0);
  EXPECT_GT(grid.sun(Vec3(1e9, -1e9, 1e9)), 0.9);
}

TEST(LightGrid, LargeScenesGetLargerCells) {
  LightGrid grid(Vec3(0, 0, 0), Vec3(20000, 20000, 40), 0.1);
  grid.cast(Vec3(0, 0, 1));
  EXPECT_NEAR(grid.sun(Vec3(10000, 10000, 10)), 1.0, 1e-5);
}

// Trees of a message may stand anywhere, for example all on one line.
TEST(LightGrid, HasNoMoreCellsThanAllowed) {
  for (const Vec3& extent : {Vec3(2e7, 0.5, 0.5), Vec3(2e7, 2e7, 0.1), Vec3(2e7, 2e7, 1e5),
                             Vec3(300, 300, 40), Vec3(1e-3, 1e-3, 1e7)})
    EXPECT_LE(LightGrid(Vec3(0, 0, 0), extent, 0.8).cells(), LightGrid::MOST_CELLS) << extent;
}

TEST(LightGrid, RefusesAnEmptyBox) {
  EXPECT_THROW(LightGrid(Vec3(0, 0, 0), Vec3(0, 1, 1), 1.0), std::invalid_argument);
  EXPECT_THROW(LightGrid(Vec3(0, 0, 0), Vec3(1, 1, 1), 0.0), std::invalid_argument);
  EXPECT_THROW(LightGrid(Vec3(0, 0, 0), Vec3(1, 1, std::numeric_limits<double>::infinity()), 1.0),
               std::invalid_argument);
}

}  // namespace
}  // namespace vegetation_sim::forest

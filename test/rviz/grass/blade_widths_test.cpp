// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/blade_widths.h"

#include <gtest/gtest.h>

namespace vegetation_sim::view {
namespace {

// However few blades are drawn, none is broad in a view from the side, and what all of them and the
// missing part cover is what all blades would.
TEST(BladeWidths, NoBladeIsBroadWhereStripsStand) {
  for (const double distance : {1.0, 5.0, 20.0})
    for (double share = grass::LEAST_SHARE; share <= 1.0; share += 0.125) {
      grass::TileView tile;
      tile.share = share;
      const BladeWidths all = widthsOf(tile, distance, false);
      const BladeWidths few = widthsOf(tile, distance, true);
      EXPECT_LE(few.own, WIDEST_BLADE + 1e-9);
      EXPECT_LE(few.beside, WIDEST_BLADE + 1e-9);
      EXPECT_EQ(all.kept, 1.0);
      EXPECT_EQ(all.missing, 0.0);
      const double broad = all.own + all.beside;
      EXPECT_NEAR(few.kept * (few.own + few.beside) + few.missing * broad, broad, 1e-9);
    }
}

TEST(BladeWidths, LeaveNoGapBetweenThem) {
  grass::TileView tile;
  EXPECT_EQ(widthsOf(tile, 5.0, true).missing, 0.0);
  double before = 0.0;
  for (double share = 1.0; share > grass::LEAST_SHARE; share -= 0.01) {
    tile.share = share;
    const double missing = widthsOf(tile, 20.0, true).missing;
    EXPECT_GE(missing, before - 1e-9);
    EXPECT_LT(missing, before + 0.06);
    before = missing;
  }
  EXPECT_GT(before, 0.7);
}

}  // namespace
}  // namespace vegetation_sim::view

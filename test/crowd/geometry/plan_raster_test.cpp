// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/plan_raster.h"

#include <gtest/gtest.h>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

TEST(PlanRaster, LargeLandscapesGetLargerCells) {
  const ObstacleGrid still({discObstacle({0, 0}, 1.0), discObstacle({5000, 5000}, 1.0)}, 3.0);
  const PlanRaster raster(still, 0.3, 0.25);
  EXPECT_LE(raster.columns() * raster.rows(), 524288);
  EXPECT_GT(raster.cell(), 0.25);
}

TEST(PlanRaster, AClosedRoomHasNoWayOut) {
  const ObstacleGrid still(room(-4, -4, 4, 4), 3.0);
  const PlanRaster raster(still, 0.3, 0.25);
  const std::uint32_t inside = raster.cellAt({0, 0}), outside = raster.cellAt({6, 0});
  const std::uint32_t wall = raster.cellAt({4, 0});
  ASSERT_TRUE(raster.isBlocked(wall));
  EXPECT_FALSE(raster.areConnected(inside, outside));
  EXPECT_TRUE(raster.areConnected(inside, raster.cellAt({-2, 3})));
  EXPECT_TRUE(raster.areConnected(outside, raster.cellAt({-6, 3})));
  EXPECT_FALSE(raster.areConnected(inside, wall));
  EXPECT_FALSE(raster.areConnected(wall, raster.cellAt({4, 1})));
  EXPECT_TRUE(raster.areConnected(wall, wall));
}

}  // namespace
}  // namespace vegetation_sim::crowd

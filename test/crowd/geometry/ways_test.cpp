// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/ways.h"

#include <gtest/gtest.h>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

// A U that is open to the west.
ObstacleGrid pocket() {
  return ObstacleGrid({wallObstacle({2, -3}, {2, 3}, 0.2), wallObstacle({-2, -3}, {2, -3}, 0.2),
                       wallObstacle({-2, 3}, {2, 3}, 0.2)},
                      3.0);
}

TEST(Ways, LeadOutOfAPocket) {
  const ObstacleGrid still = pocket();
  const PlanRaster raster(still, 0.3, 0.25);
  const FlowField field(raster, raster.cellAt({8, 0}));
  Point at{1.0, 0.0}, aim;
  double way = 0.0;
  for (int i = 0; i < 400 && length(Point{8, 0} - at) > 0.3; ++i) {
    ASSERT_TRUE(field.aimFrom(raster, at, {8, 0}, aim));
    const Point to = aim - at;
    const Point next = at + (std::min(0.1, length(to)) / length(to)) * to;
    for (const Obstacle& wall : still.obstacles())
      ASSERT_FALSE(separation(next, 0.25, wall).overlapping) << next.x << " " << next.y;
    at = next;
    way += 0.1;
  }
  EXPECT_LT(length(Point{8, 0} - at), 0.31);
  // Out to the mouth's corner and back along the arm: 3.3 + 0.5 + 4.2 + 6.5 m, and the steps'
  // turns.
  EXPECT_LT(way, 17.0);
}

TEST(Ways, StraightWhereNothingIsBetween) {
  const PlanRaster raster(pocket(), 0.3, 0.25);
  const FlowField field(raster, raster.cellAt({8, 0}));
  Point aim;
  ASSERT_TRUE(field.aimFrom(raster, {3, 2}, {8, 0}, aim));
  EXPECT_EQ(aim.x, 8.0);
  EXPECT_EQ(aim.y, 0.0);
}

TEST(Ways, AClosedRoomHasNoWayOut) {
  const ObstacleGrid still(room(-4, -4, 4, 4), 3.0);
  const PlanRaster raster(still, 0.3, 0.25);
  const FlowField field(raster, raster.cellAt({6, 0}));
  Point aim;
  EXPECT_FALSE(field.isReachable(raster, {0, 0}));
  EXPECT_FALSE(field.aimFrom(raster, {0, 0}, {6, 0}, aim));
  EXPECT_TRUE(field.isReachable(raster, {6, 3}));
}

// N6: earlier queries change no result.
TEST(Ways, GoalsInOneCellAreNotMixedUp) {
  Ways ways;
  ways.setObstacles(pocket(), 0.3, 0.25);
  const Point goals[2] = {{8.01, 0.01}, {8.09, 0.11}};
  ASSERT_EQ(ways.raster().cellAt(goals[0]), ways.raster().cellAt(goals[1]));
  ASSERT_EQ(&ways.fieldOf(goals[0]), &ways.fieldOf(goals[1]));
  for (const Point& goal : goals) {
    Point aim;
    ASSERT_TRUE(ways.fieldOf(goal).aimFrom(ways.raster(), {4, 0}, goal, aim));
    EXPECT_EQ(aim.x, goal.x);
    EXPECT_EQ(aim.y, goal.y);
  }
}

TEST(Ways, UnusedFieldsAreFreed) {
  Ways ways;
  ways.setObstacles(pocket(), 0.3, 0.25);
  for (int i = 0; i < 200; ++i) {
    ways.fieldOf({-4.9 + 0.25 * (i % 40), 4.0 + 0.25 * (i / 40)});
    ways.endTick();
  }
  EXPECT_LE(ways.count(), 125U);
  for (int i = 0; i < 200; ++i) ways.endTick();
  EXPECT_LE(ways.count(), 32U);
}

// 128 MB of them at the most, but for those that are in use now.
TEST(Ways, FieldsOfLargeLandscapesGoSooner) {
  Ways ways;
  ways.setObstacles(ObstacleGrid({discObstacle({0, 0}, 1.0), discObstacle({900, 900}, 1.0)}, 3.0),
                    0.3, 0.25);
  for (int i = 0; i < 110; ++i) {
    ways.fieldOf({5.0 + 8.0 * i, 40.0});
    ways.endTick();
  }
  const auto cells = static_cast<std::size_t>(ways.raster().columns() * ways.raster().rows());
  const std::size_t most = (std::size_t{1} << 25) / cells + 1;
  ASSERT_LT(most, 100U);
  EXPECT_LE(ways.count(), most);
  EXPECT_GT(ways.count(), most / 2);
  EXPECT_TRUE(ways.isReachable({3, 3}, {700, 700}));
  EXPECT_LE(ways.count(), most);
}

TEST(Ways, LargeLandscapesGetLargerCells) {
  const ObstacleGrid still({discObstacle({0, 0}, 1.0), discObstacle({5000, 5000}, 1.0)}, 3.0);
  const PlanRaster raster(still, 0.3, 0.25);
  EXPECT_LE(raster.columns() * raster.rows(), 524288);
  EXPECT_GT(raster.cell(), 0.25);
}

}  // namespace
}  // namespace vegetation_sim::crowd

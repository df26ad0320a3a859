// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/obstacle_grid.h"

#include <gtest/gtest.h>

#include <set>

#include "heap.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

std::vector<Obstacle> aslantWalls(int count, double size) {
  std::vector<Obstacle> out;
  for (int i = 0; i < count; ++i)
    out.push_back(wallObstacle({7.0 * i, 0}, {7.0 * i + size, size}, 0.2));
  return out;
}

bool touches(const Obstacle& obstacle, const Point& place, double range) {
  const Extent e = extentOf(obstacle);
  return e.low.x <= place.x + range && e.high.x >= place.x - range && e.low.y <= place.y + range &&
         e.high.y >= place.y - range;
}

// S2-30: whatever a scenario has, what comes near is found, each once.
TEST(ObstacleGrid, VisitsEachNearObstacleOnce) {
  const ObstacleGrid grid(aslantWalls(60, 100.0), 3.0);
  for (int i = 0; i < 200; ++i) {
    const Random random = Random(4).child(i);
    const Point place{random.uniform(0, -20.0, 540.0), random.uniform(1, -20.0, 120.0)};
    std::multiset<std::uint32_t> published;
    grid.visitNear(place, 2.5,
                   [&](const ObstacleGrid::Spot& spot) { published.insert(spot.index); });
    for (std::uint32_t k = 0; k < grid.obstacles().size(); ++k) {
      EXPECT_LE(published.count(k), 1u);
      EXPECT_GE(published.count(k), touches(grid.obstacles()[k], place, 2.5) ? 1u : 0u)
          << i << ' ' << k;
    }
  }
}

TEST(ObstacleGrid, LongWallsThatLieAslantDoNotFillTheMemory) {
  const long before = liveBytes();
  const ObstacleGrid grid(aslantWalls(200, 1000.0), 3.0);
  EXPECT_EQ(grid.obstacles().size(), 200u);
  EXPECT_LT(liveBytes() - before, 120'000'000);
}

TEST(ObstacleGrid, ManySmallOnesKeepTheCellThatWasAskedFor) {
  std::vector<Obstacle> trunks;
  for (int i = 0; i < 300000; ++i)
    trunks.push_back(discObstacle({2.0 * (i % 600), 2.0 * (i / 600)}, 0.3));
  const ObstacleGrid grid(std::move(trunks), 2.0);
  int published = 0;
  grid.visitNear({600.0, 500.0}, 0.5, [&](const ObstacleGrid::Spot&) { ++published; });
  EXPECT_LE(published, 9);
}

}  // namespace
}  // namespace vegetation_sim::crowd

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/way_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <queue>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

// A U that is open to the west.
ObstacleGrid pocket() {
  return ObstacleGrid({wallObstacle({2, -3}, {2, 3}, 0.2), wallObstacle({-2, -3}, {2, -3}, 0.2),
                       wallObstacle({-2, 3}, {2, 3}, 0.2)},
                      3.0);
}

ObstacleGrid scatteredWalls(std::uint64_t seed) {
  const Random random(seed);
  std::vector<Obstacle> out;
  for (std::uint64_t i = 0; i < 25; ++i) {
    const Point from{random.uniform(4 * i, 0.0, 30.0), random.uniform(4 * i + 1, 0.0, 20.0)};
    const SinCos turn = sinCosTurns(random.uniform(4 * i + 2));
    const double size = random.uniform(4 * i + 3, 1.0, 12.0);
    out.push_back(wallObstacle(from, from + size * Point{turn.cos, turn.sin}, 0.2));
  }
  return ObstacleGrid(std::move(out), 3.0);
}

void searchFor(const PlanRaster& raster, std::uint32_t cell, WaySearch& search) {
  while (!search.isKnown(raster, cell)) ASSERT_EQ(search.expand(raster, 1), 1u);
}

Point searchAim(const PlanRaster& raster, const Point& from, WaySearch& search) {
  const Point start = raster.nearestFree(from);
  searchFor(raster, raster.cellAt(start), search);
  Point out;
  EXPECT_TRUE(search.aimFrom(raster, start, out));
  return out;
}

/// Lengths of the ways from all cells, by Dijkstra's algorithm.
std::vector<std::uint32_t> lengthsTo(const PlanRaster& raster, std::uint32_t goal) {
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // length, cell
  std::vector<std::uint32_t> out(static_cast<std::size_t>(raster.columns()) * raster.rows(),
                                 std::numeric_limits<std::uint32_t>::max());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  out[goal] = 0;
  for (waiting.push({0, goal}); !waiting.empty();) {
    const auto [length, cell] = waiting.top();
    waiting.pop();
    if (length != out[cell]) continue;
    raster.visitNeighbours(cell, [&, own = length](const Neighbour& next) {
      if (own + next.cost >= out[next.cell]) return;
      out[next.cell] = own + next.cost;
      waiting.push({out[next.cell], next.cell});
    });
  }
  return out;
}

/// The farthest visible one of the next 32 cells, each of which is the neighbour nearest to the
/// goal.
Point aimBy(const std::vector<std::uint32_t>& lengths, const PlanRaster& raster,
            const Point& from) {
  const Point start = raster.nearestFree(from);
  std::uint32_t cell = raster.cellAt(start), path[32];
  for (std::uint32_t& at : path) {
    at = cell;
    raster.visitNeighbours(cell, [&](const Neighbour& next) {
      if (lengths[next.cell] < lengths[at]) at = next.cell;
    });
    cell = at;
  }
  for (int i = 31; i > 0; i = i * 2 / 3)
    if (raster.isClear(start, raster.centreOf(path[i]), false)) return raster.centreOf(path[i]);
  return raster.centreOf(path[0]);
}

TEST(WaySearch, LeadsOutOfAPocket) {
  const ObstacleGrid still = pocket();
  const PlanRaster raster(still, 0.3, 0.25);
  const Point goal{8.0, 0.0};
  Point at{1.0, 0.0};
  WaySearch ways(raster.cellAt(goal), raster.cellAt(at));
  double way = 0.0;
  for (int i = 0; i < 400 && length(goal - at) > 0.3; ++i) {
    Point aim = goal;
    if (!raster.isClear(at, goal, false)) aim = searchAim(raster, at, ways);
    const Point to = aim - at;
    const Point next = at + (std::min(0.1, length(to)) / length(to)) * to;
    for (const Obstacle& wall : still.obstacles())
      ASSERT_FALSE(separation(next, 0.25, wall).overlapping) << next.x << " " << next.y;
    at = next;
    way += 0.1;
  }
  EXPECT_LT(length(goal - at), 0.31);
  // Out to the mouth's corner and back along the arm: 3.3 + 0.5 + 4.2 + 6.5 m, and the steps'
  // turns.
  EXPECT_LT(way, 17.0);
}

// N6: the order of the questions changes no answer.
TEST(WaySearch, AimsAreThoseOfAllCells) {
  int asked = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const PlanRaster raster(scatteredWalls(seed), 0.3, 0.25);
    const Random random = Random(seed).child(1);
    const auto place = [&](std::uint64_t i) {
      return raster.nearestFree(
          {random.uniform(2 * i, -2.0, 32.0), random.uniform(2 * i + 1, -2.0, 22.0)});
    };
    const std::uint32_t goal = raster.cellAt(place(0));
    const std::vector<std::uint32_t> lengths = lengthsTo(raster, goal);
    WaySearch ways(goal, raster.cellAt(place(1)));
    for (std::uint64_t i = 1; i < 40; ++i) {
      const Point from = place(i);
      if (!raster.areConnected(raster.cellAt(from), goal)) continue;
      const Point aim = searchAim(raster, from, ways), right = aimBy(lengths, raster, from);
      ASSERT_EQ(aim.x, right.x) << seed << ' ' << i;
      ASSERT_EQ(aim.y, right.y) << seed << ' ' << i;
      ++asked;
    }
  }
  EXPECT_GT(asked, 200);
}

// Cells beside the way are left out until somebody is there.
TEST(WaySearch, ClosesFewCells) {
  const PlanRaster raster(
      ObstacleGrid({wallObstacle({20, 18}, {20, 22}, 0.2), wallObstacle({0, 0}, {1, 0}, 0.2),
                    wallObstacle({39, 40}, {40, 40}, 0.2)},
                   3.0),
      0.3, 0.25);
  const std::uint32_t west = raster.cellAt({10, 20}), east = raster.cellAt({30, 20});
  WaySearch ways(east, west);
  searchFor(raster, west, ways);
  const auto all = static_cast<std::uint32_t>(raster.columns() * raster.rows());
  EXPECT_LT(ways.progress().closed, all / 8);
  EXPECT_LT(ways.bytes(), all / 2);
  searchFor(raster, raster.cellAt({38, 2}), ways);
  EXPECT_GT(ways.progress().closed, all / 8);
  while (ways.expand(raster, 1000) == 1000) {
  }
  EXPECT_LT(ways.progress().closed, all) << "walls are never closed";
  EXPECT_TRUE(ways.isKnown(raster, raster.cellAt({1, 39})));
}

}  // namespace
}  // namespace vegetation_sim::crowd

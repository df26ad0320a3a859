// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/perception.h"

#include <gtest/gtest.h>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

std::vector<Obstacle> mixedObstacles(int count, double side) {
  const Random random(5);
  std::vector<Obstacle> out;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint64_t>(6 * i);
    const Point at{random.uniform(k, 0.0, side), random.uniform(k + 1, 0.0, side)};
    const double yaw = random.uniform(k + 2, -PI, PI), size = random.uniform(k + 3, 0.1, 0.5);
    if (i % 4 == 0)
      out.push_back(discObstacle(at, size));
    else if (i % 4 == 1)
      out.push_back(boxObstacle(at, size, 0.5 * size, yaw));
    else if (i % 4 == 2)  // far larger than a cell
      out.push_back(wallObstacle(at, at + Point{random.uniform(k + 4, -20.0, 20.0), 3.0}, 0.1));
    else
      out.push_back(outlineObstacle({{size, 0}, {-size, size}, {-size, -size}}, at, yaw));
  }
  return out;
}

std::vector<Walker> people(int count, double side) {
  const Random random(6);
  std::vector<Walker> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].position = {random.uniform(2 * i, -2.0, side + 2.0),
                       random.uniform(2 * i + 1, -2.0, side + 2.0)};
    out[i].radius = 0.2 + 0.01 * static_cast<double>(i % 10);
  }
  return out;
}

// S2-31, S2-30: trunks, walls, robots and others; the several nearest, as measuring all gives them.
TEST(Perception, GridGivesTheSameAsMeasuringAll) {
  constexpr double SIDE = 60.0, RANGE = 2.5;
  const ObstacleGrid still(mixedObstacles(300, SIDE), RANGE);
  const std::vector<Walker> walkers = people(400, SIDE);
  WalkerGrid grid;
  grid.build(walkers, RANGE + 2.0 * 0.3);
  const std::vector<Obstacle> robots{discObstacle({20, 20}, 3.0)};
  const Surroundings around{&still, &grid, &robots};
  int seen = 0;
  for (const int most : {1, 3, 8})
    for (std::uint32_t i = 0; i < walkers.size(); ++i) {
      const View some = perceive(walkers[i], i, around, RANGE, most);
      const View all = perceiveAll(walkers[i], i, walkers, around, RANGE, most);
      ASSERT_EQ(some.count, all.count) << i;
      for (int k = 0; k < all.count; ++k) {
        ASSERT_EQ(some.at(k).kind, all.at(k).kind) << i;
        ASSERT_EQ(some.at(k).index, all.at(k).index) << i;
        ASSERT_NEAR(some.at(k).gap, all.at(k).gap, 1e-12) << i;
      }
      ASSERT_LE(some.beyond, all.beyond + 1e-12) << i;
      seen += all.count;
    }
  EXPECT_GT(seen, 1000);
}

TEST(Perception, EveryAnswerHasItsProof) {
  const ObstacleGrid still(mixedObstacles(300, 40.0), 2.5);
  const std::vector<Walker> walkers = people(200, 40.0);
  WalkerGrid grid;
  grid.build(walkers, 3.1);
  const std::vector<Obstacle> robots;
  for (std::uint32_t i = 0; i < walkers.size(); ++i) {
    const View view = perceive(walkers[i], i, {&still, &grid, &robots}, 2.5, 3);
    for (int k = 0; k < view.count; ++k) EXPECT_LE(view.at(k).gap - view.at(k).lower, 1e-10);
  }
}

TEST(Perception, NothingInRangeIsNothingSeen) {
  const ObstacleGrid still({discObstacle({10, 0}, 0.3)}, 3.0);
  std::vector<Walker> walkers(1);
  WalkerGrid grid;
  grid.build(walkers, 3.5);
  const std::vector<Obstacle> robots;
  const View view = perceive(walkers[0], 0, {&still, &grid, &robots}, 3.0, 3);
  EXPECT_EQ(view.count, 0);
  EXPECT_EQ(view.beyond, 3.0);
  // Far outside the grid's own cells.
  walkers[0].position = {-5e4, 7e4};
  grid.build(walkers, 3.5);
  EXPECT_EQ(perceive(walkers[0], 0, {&still, &grid, &robots}, 3.0, 3).count, 0);
}

TEST(Perception, InsideAnObstacleTheWayOutIsKnown) {
  const ObstacleGrid still({boxObstacle({0, 0}, 2.0, 1.0, 0.0)}, 3.0);
  std::vector<Walker> walkers(1);
  walkers[0].position = {0.3, 0.7};
  WalkerGrid grid;
  grid.build(walkers, 3.5);
  const std::vector<Obstacle> robots;
  const View view = perceive(walkers[0], 0, {&still, &grid, &robots}, 3.0, 3);
  ASSERT_EQ(view.count, 1);
  EXPECT_NEAR(view.at(0).gap, -0.25 - 0.3, 1e-12);
  EXPECT_NEAR(view.at(0).normal.y, -1.0, 1e-12);
}

// A crowd in one cell: more candidates than are sorted.
TEST(Perception, AThrongIsSeenByItsNearest) {
  std::vector<Walker> walkers(500);
  for (std::size_t i = 0; i < walkers.size(); ++i)
    walkers[i].position = {0.004 * static_cast<double>(i), 0.0};
  WalkerGrid grid;
  grid.build(walkers, 3.5);
  const ObstacleGrid still;
  const std::vector<Obstacle> robots;
  const Surroundings around{&still, &grid, &robots};
  for (const std::uint32_t i : {0U, 250U, 499U}) {
    const View some = perceive(walkers[i], i, around, 3.0, 3);
    const View all = perceiveAll(walkers[i], i, walkers, around, 3.0, 3);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(some.at(k).index, all.at(k).index);
  }
}

}  // namespace
}  // namespace vegetation_sim::crowd

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/ways.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

// A wall between x = 10 and x = 12, and a raster of `size` m around it.
Ways waysAroundAWall(double size, std::size_t most_bytes = Ways::MOST_BYTES) {
  Ways out(most_bytes);
  out.setObstacles(ObstacleGrid({wallObstacle({10, 0}, {12, 40}, 0.2), discObstacle({0, 0}, 0.1),
                                 discObstacle({size, size}, 0.1)},
                                3.0),
                   0.3, 0.25);
  return out;
}

WayQuery ask(const Point& from, const Point& goal) {
  WayQuery out;
  out.from = from;
  out.goal = goal;
  return out;
}

void tick(Ways& ways, std::vector<WayQuery>& queries) {
  for (WayQuery& query : queries) ways.look(query);
  ways.assign(queries);
  for (WayQuery& query : queries) ways.follow(query);
  ways.extend(queries);
}

Point aim(Ways& ways, const Point& from, const Point& goal) {
  std::vector<WayQuery> queries{ask(from, goal)};
  tick(ways, queries);
  return queries[0].aim;
}

TEST(Ways, StraightWhereNothingIsBetween) {
  Ways ways = waysAroundAWall(50.0);
  EXPECT_EQ(aim(ways, {20, 2}, {30.0, 7.0}).y, 7.0);
  EXPECT_EQ(ways.count(), 0u);
  EXPECT_NE(aim(ways, {5, 20}, {30.0, 7.0}).y, 7.0);
  EXPECT_EQ(ways.count(), 1u);
}

// N6: earlier queries change no result.
TEST(Ways, GoalsInOneCellAreNotMixedUp) {
  Ways ways = waysAroundAWall(50.0);
  const Point goals[2] = {{30.01, 7.01}, {30.06, 7.05}};
  ASSERT_EQ(ways.raster().cellAt(goals[0]), ways.raster().cellAt(goals[1]));
  std::vector<WayQuery> queries{ask({5, 20}, goals[0]), ask({5, 21}, goals[1]),
                                ask({20, 5}, goals[1])};
  tick(ways, queries);
  EXPECT_EQ(ways.count(), 1u);
  EXPECT_EQ(queries[0].shared, queries[1].shared);
  EXPECT_EQ(queries[2].aim.x, goals[1].x);
  EXPECT_EQ(queries[2].aim.y, goals[1].y);
}

TEST(Ways, AreDroppedWithTheirLastWalker) {
  Ways ways = waysAroundAWall(50.0);
  std::vector<WayQuery> queries{ask({5, 20}, {30, 7}), ask({5, 20}, {30, 9})};
  tick(ways, queries);
  EXPECT_EQ(ways.count(), 2u);
  const std::size_t both = ways.bytes();
  queries.pop_back();
  tick(ways, queries);
  EXPECT_EQ(ways.count(), 1u);
  EXPECT_LT(ways.bytes(), both);
  queries[0].from = {20.0, 7.0};  // sees the goal
  tick(ways, queries);
  EXPECT_EQ(ways.count(), 1u);
  queries.clear();
  tick(ways, queries);
  EXPECT_EQ(ways.count(), 0u);
  EXPECT_EQ(ways.bytes(), 0u);
}

TEST(Ways, TheOldestSearchComesFirstAndTheOthersWait) {
  Ways ways = waysAroundAWall(80.0);
  std::vector<WayQuery> queries;
  for (int i = 0; i < 50; ++i) queries.push_back(ask({1.0 + 0.1 * i, 10.0}, {60.0, 1.0 + i}));
  std::size_t known = 0;
  for (int ticks = 1; known < queries.size(); ++ticks) {
    ASSERT_LT(ticks, 100);
    tick(ways, queries);
    EXPECT_LE(ways.closed(), Ways::MOST_CELLS);
    known = 0;
    while (known < queries.size() && queries[known].is_known) ++known;
    if (ticks == 1) {
      EXPECT_EQ(ways.closed(), Ways::MOST_CELLS);
      EXPECT_GT(known, 1u);
      EXPECT_LT(known, 25u);
    }
    for (std::size_t i = known + 1; i < queries.size(); ++i) EXPECT_EQ(queries[i].aim.y, 1.0 + i);
  }
}

TEST(Ways, SearchesThatDoNotFitIntoTheMemoryWait) {
  constexpr std::size_t MOST = 4'000'000;
  Ways ways = waysAroundAWall(80.0, MOST);
  std::vector<WayQuery> queries;
  const Random random(4);
  for (std::uint64_t i = 0; i < 300; ++i)
    queries.push_back(
        ask({random.uniform(3 * i, 0.0, 9.0), 20.0},
            {random.uniform(3 * i + 1, 40.0, 80.0), random.uniform(3 * i + 2, 0.0, 80.0)}));
  const auto settle = [&] {
    do {
      tick(ways, queries);
      ASSERT_LE(ways.bytes(), MOST);
    } while (ways.closed() > 0);
  };
  const auto countWaiting = [&] {
    std::size_t out = 0;
    for (const WayQuery& query : queries) out += !query.is_known;
    return out;
  };
  settle();
  EXPECT_GT(ways.bytes(), MOST / 2);
  const std::size_t waiting = countWaiting();
  EXPECT_GT(waiting, 50u);
  EXPECT_LT(waiting, 250u);
  queries.erase(queries.begin(), queries.begin() + 40);
  settle();
  EXPECT_LT(countWaiting(), waiting - 20) << "the memory of those that arrived is used again";
}

// A search depends on its progress alone.
TEST(Ways, ResumeWhereTheyWere) {
  Ways ways = waysAroundAWall(150.0), other = waysAroundAWall(150.0);
  std::vector<WayQuery> queries;
  for (int i = 0; i < 60; ++i) queries.push_back(ask({1.0, 10.0 + 0.1 * i}, {100.0, 1.0 + i}));
  tick(ways, queries);
  std::vector<WayProgress> saved = ways.progress();
  saved.push_back({0xFFFFFFFFu, 0, 5});  // outside of the raster
  other.resume(saved);
  EXPECT_EQ(other.bytes(), ways.bytes());
  std::vector<WayQuery> same = queries;
  for (int i = 0; i < 5; ++i) {
    tick(ways, queries);
    tick(other, same);
    EXPECT_EQ(other.closed(), ways.closed());
    for (std::size_t k = 0; k < queries.size(); ++k) {
      ASSERT_EQ(same[k].is_known, queries[k].is_known);
      ASSERT_EQ(same[k].aim.x, queries[k].aim.x);
      ASSERT_EQ(same[k].aim.y, queries[k].aim.y);
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::crowd

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Ways of many walkers among walls.
#include <gtest/gtest.h>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

// S2-33: every tick does a bounded work, and nevertheless walkers arrive.
TEST(CrowdWays, AThousandWanderersFindTheirWaysWithinTheBounds) {
  Crowd crowd = houseOfRooms(1000, 200.0, 1);
  std::vector<Walker> before = crowd.walkers();
  std::size_t arrived = 0, most_cells = 0, most_bytes = 0, most_searches = 0, waiting = 0;
  int tick = 0;
  run(crowd, 120.0, 0.1, [&](const Crowd& c) {
    const Ways& ways = c.ways();
    most_cells = std::max(most_cells, ways.closed());
    most_bytes = std::max(most_bytes, ways.bytes());
    most_searches = std::max(most_searches, ways.count());
    if (++tick > 1100)
      for (const WayProgress& search : ways.progress()) waiting += search.closed == 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Walker& w = before[i];
      const bool is_near = length(w.goal - w.position) < c.snapshot().settings.arrival + 0.5;
      arrived += w.goals > 0 && c.walkers()[i].goals > w.goals && is_near;
    }
    before = c.walkers();
  });
  EXPECT_LE(most_cells, std::size_t{65536});
  EXPECT_LT(most_bytes, std::size_t{128'000'000});
  EXPECT_GT(most_searches, 900u);
  EXPECT_LT(waiting, 100u * 5u) << "in the last hundred ticks only those with new goals wait";
  EXPECT_GT(arrived, 400u);
}

TEST(CrowdWays, SameHashForAnyNumberOfThreads) {
  Crowd one = houseOfRooms(600, 100.0, 2), three = houseOfRooms(600, 100.0, 2);
  three.setThreads(3);
  std::size_t most = 0;
  run(one, 6.0, 0.1, [&](const Crowd& c) { most = std::max(most, c.ways().closed()); });
  run(three, 6.0, 0.1);
  EXPECT_EQ(most, Ways::MOST_CELLS) << "some must wait";
  EXPECT_EQ(one.snapshot().hash(), three.snapshot().hash());
}

// Saved while walkers wait for their ways; another process has none of the searches.
TEST(CrowdWays, GoOnFromSavedBytes) {
  Crowd first = houseOfRooms(600, 100.0, 3), second = houseOfRooms(1, 100.0, 3);
  run(first, 1.0, 0.1);
  ASSERT_EQ(first.ways().closed(), Ways::MOST_CELLS);
  second.restore(Crowd::readArchived(first.archived()));
  EXPECT_EQ(second.archived(), first.archived());
  for (int i = 0; i < 30; ++i) {
    run(first, 0.1, 0.1);
    run(second, 0.1, 0.1);
    ASSERT_EQ(first.snapshot().hash(), second.snapshot().hash()) << i;
  }
}

}  // namespace
}  // namespace vegetation_sim::crowd

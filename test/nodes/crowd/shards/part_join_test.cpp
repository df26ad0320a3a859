// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/shards/part_join.h"

#include <gtest/gtest.h>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = 100000000;
constexpr int PATIENCE = 5;  // ticks in PartJoin::LONGEST_WAIT

// People whose places tell the tick.
CrowdPart partOf(std::uint32_t shard, int tick, const std::vector<std::uint32_t>& ids) {
  CrowdPart out;
  out.shard = shard;
  out.people.header.stamp = toStamp(tick * TICK);
  out.people.hash = 100 * shard + tick;
  for (const std::uint32_t id : ids) {
    AgentState agent;
    agent.id = id;
    agent.pose.position.x = tick;
    out.people.agents.push_back(agent);
  }
  return out;
}

std::vector<int> idsOf(const JoinedPeople& people) {
  std::vector<int> out;
  for (const AgentState& agent : people.agents) out.push_back(agent.id);
  return out;
}

int tickOf(const AgentState& agent) {
  return int(agent.pose.position.x);
}

// Adds the own part of a tick, which is the last one. Returns the stamps, in ticks, of all people
// that are complete.
std::vector<int> runTick(PartJoin& join, int tick) {
  join.setTime(tick * TICK);
  join.add(partOf(0, tick, {1, 2}));
  std::vector<int> out;
  while (const auto people = join.take()) out.push_back(int(people->stamp / TICK));
  return out;
}

using Ticks = std::vector<int>;

TEST(PartJoin, WaitsForAllShards) {
  PartJoin join(2, 0);
  EXPECT_EQ(runTick(join, 1), Ticks());
  join.add(partOf(1, 1, {3, 2}));
  const auto people = join.take();
  ASSERT_TRUE(people);
  EXPECT_EQ(idsOf(*people), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(people->hash, 102u);
  EXPECT_EQ(join.stamp(), TICK);
  EXPECT_FALSE(join.take());
}

TEST(PartJoin, DoesNotReturnATickThatThisNodeHasNotReached) {
  PartJoin join(2, 0);
  for (const int tick : {1, 2}) join.add(partOf(1, tick, {3}));
  EXPECT_EQ(runTick(join, 1), Ticks{1});
  EXPECT_EQ(runTick(join, 2), Ticks{2});
}

// The people of a shard that dies stand as they were last, and are awaited no longer.
TEST(PartJoin, ShowsThePeopleOfASilentShardAsTheyWere) {
  PartJoin join(2, 0);
  join.add(partOf(1, 1, {3}));
  EXPECT_EQ(runTick(join, 1), Ticks{1});
  for (int tick = 2; tick <= PATIENCE + 1; ++tick) EXPECT_EQ(runTick(join, tick), Ticks());
  join.setTime((PATIENCE + 2) * TICK);
  join.add(partOf(0, PATIENCE + 2, {1, 2}));
  for (int tick = 2; tick <= PATIENCE + 2; ++tick) {
    const auto people = join.take();
    ASSERT_TRUE(people);
    ASSERT_EQ(idsOf(*people), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(tickOf(people->agents[0]), tick);
    EXPECT_EQ(tickOf(people->agents[2]), 1);
  }
  EXPECT_EQ(runTick(join, PATIENCE + 3), Ticks{PATIENCE + 3});
  EXPECT_EQ(join.late(), 0u);
  join.add(partOf(1, PATIENCE + 3, {3}));
  EXPECT_EQ(join.late(), 1u);
  EXPECT_EQ(runTick(join, PATIENCE + 4), Ticks()) << "it is awaited again";
}

// One who has gone to a shard that runs is no longer where the silent one had him last.
TEST(PartJoin, MovesPeopleWhoHaveLeftASilentShard) {
  PartJoin join(2, 0);
  join.add(partOf(1, 1, {2, 3}));
  join.setTime(TICK);
  join.add(partOf(0, 1, {1}));
  ASSERT_TRUE(join.take());
  for (int tick = 2; tick <= PATIENCE + 2; ++tick) runTick(join, tick);
  join.setTime((PATIENCE + 3) * TICK);
  join.add(partOf(0, PATIENCE + 3, {1}));
  const auto people = join.take();
  ASSERT_TRUE(people);
  EXPECT_EQ(idsOf(*people), (std::vector<int>{1, 3}));
}

// A part that was on its way when the clock jumped back would show people of before, and the shard
// would not be awaited.
TEST(PartJoin, IgnoresPartsFromBeforeAJumpBack) {
  PartJoin join(2, 0);
  join.add(partOf(1, 50, {3}));
  EXPECT_EQ(runTick(join, 50), Ticks{50});
  join.jumpBack();
  join.add(partOf(1, 51, {3}));
  EXPECT_EQ(runTick(join, 20), Ticks());
  join.add(partOf(1, 20, {3}));
  const auto people = join.take();
  ASSERT_TRUE(people);
  ASSERT_EQ(idsOf(*people), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(tickOf(people->agents[2]), 20);
  EXPECT_EQ(runTick(join, 21), Ticks());
}

// It need not have jumped: it may have died before, and start again later.
TEST(PartJoin, HearsAShardAgainThatWasSilentAtAJumpBack) {
  PartJoin join(2, 0);
  join.add(partOf(1, 3, {3}));
  EXPECT_EQ(runTick(join, 3), Ticks{3});
  join.jumpBack();
  for (int tick = 1; tick <= 10; ++tick) runTick(join, tick);
  join.add(partOf(1, 11, {3}));
  EXPECT_EQ(runTick(join, 11), Ticks{11});
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_inputs.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND / 25;

ForestInput resetAt(std::int64_t tick) {
  ForestInput out;
  out.kind = ForestInput::RESET;
  out.stamp = tick * TICK;
  return out;
}

// N6: an event of a replay is in time at its own tick and late after it, whatever the reason.
TEST(ForestInputs, CountLateEventsOfAReplay) {
  ForestInputs inputs(true);
  for (const std::int64_t tick : {101, 102, 104}) inputs.addRecorded(resetAt(tick));
  EXPECT_TRUE(inputs.take(100 * TICK).empty());
  EXPECT_EQ(inputs.take(101 * TICK).size(), 1u);
  EXPECT_EQ(inputs.take(102 * TICK).size(), 1u);
  EXPECT_EQ(inputs.losses().late, 0u);
  inputs.addRecorded(resetAt(99));
  EXPECT_EQ(inputs.take(105 * TICK).size(), 2u);  // Tick 104 was dropped, and 99 arrived late.
  EXPECT_EQ(inputs.losses().late, 2u);
  EXPECT_EQ(inputs.losses().lost, 0u);
}

TEST(ForestInputs, CountEventsAboveTheLimit) {
  ForestInputs inputs(true);
  for (std::size_t i = 0; i < ForestInputs::MOST_WAITING + 3; ++i) inputs.addRecorded(resetAt(7));
  EXPECT_EQ(inputs.losses().lost, 3u);
  EXPECT_EQ(inputs.take(7 * TICK).size(), ForestInputs::MOST_WAITING);
}

TEST(ForestInputs, CountSensorsAboveTheLimit) {
  ForestInputs inputs(false);
  ForestInput event;
  event.kind = ForestInput::SENSOR;
  for (std::size_t i = 0; i < ForestInputs::MOST_WAITING + 2; ++i) {
    event.sensor.id = std::to_string(i);
    EXPECT_EQ(inputs.add(event), i < ForestInputs::MOST_WAITING);
  }
  EXPECT_EQ(inputs.losses().lost, 2u);
}

// N6: a recorded force is replayed with the whole tree that it made physical.
TEST(ForestInputs, AForceOfAWholeTreeSurvivesItsEvent) {
  ForestInput force;
  force.kind = ForestInput::FORCE;
  force.push.point = {3, 7, 0.25};
  force.push.until = TICK;
  for (const bool whole : {false, true}) {
    force.push.whole_tree = whole;
    EXPECT_EQ(eventFromMsg(eventToMsg(force)).push.whole_tree, whole);
  }
}

// N6: a flood of requests for later stamps blocks neither the wind nor the node's own events.
TEST(ForestInputs, AcceptTheNodesOwnEventsInAFlood) {
  ForestInputs inputs(false);
  ForestInput force;
  force.kind = ForestInput::FORCE;
  force.stamp = 100 * TICK;
  for (std::size_t i = 0; i < ForestInputs::MOST_AHEAD; ++i) EXPECT_TRUE(inputs.add(force));
  EXPECT_FALSE(inputs.add(force));
  ForestInput body;
  body.kind = ForestInput::BODY;
  inputs.addFirst(body);
  for (const std::uint8_t kind : {ForestInput::WIND, ForestInput::SETTINGS, ForestInput::RESET}) {
    ForestInput event;
    event.kind = kind;
    EXPECT_TRUE(inputs.add(event));
  }
  std::vector<int> kinds;
  for (const ForestInput& event : inputs.take(TICK)) kinds.push_back(event.kind);
  EXPECT_EQ(kinds, (std::vector<int>{ForestInput::BODY, ForestInput::WIND, ForestInput::SETTINGS,
                                     ForestInput::RESET}));
  EXPECT_EQ(inputs.losses().lost, 0u);
  EXPECT_EQ(inputs.take(100 * TICK).size(), ForestInputs::MOST_AHEAD);
}

// N3: the last move of a grab at a tick counts. A renewal does not change it.
TEST(ForestInputs, RenewalsLeaveMovesAlone) {
  ForestInputs inputs(false);
  ForestInput move;
  move.kind = ForestInput::MOVE;
  move.grab.id = 1;
  move.grab.target.x() = 1.0;
  inputs.add(move);
  move.grab.target.x() = 2.0;
  inputs.add(move);
  ForestInput renewal;
  renewal.kind = ForestInput::RENEW;
  renewal.grab.id = 1;
  inputs.add(renewal);
  inputs.add(renewal);
  const std::vector<ForestInput> taken = inputs.take(TICK);
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0].kind, ForestInput::MOVE);
  EXPECT_EQ(taken[0].grab.target.x(), 2.0);
  EXPECT_EQ(taken[1].kind, ForestInput::RENEW);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

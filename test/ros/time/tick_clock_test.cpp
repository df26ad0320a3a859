// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/time/tick_clock.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vegetation_sim {
namespace {

constexpr Nanoseconds SECOND = NANOSECONDS_PER_SECOND;
constexpr Nanoseconds UNIX = 1700000000 * SECOND;

/// N6: all nodes handle time by the same rule.
class TickClockTest : public testing::Test {
 protected:
  void SetUp() override { ros::Time::init(); }  // The warnings of the clock need ROS time.
  TickClock make(double delay = 0.0, LateTicks late = LateTicks::EACH) {
    TickCalls calls;
    calls.before = [this] { did_.push_back("before"); };
    calls.tick = [this](std::int64_t tick) { did_.push_back(std::to_string(tick)); };
    calls.back = [this](Nanoseconds clock) {
      did_.push_back("back to " + std::to_string(clock / SECOND));
    };
    return TickClock("node", 10, delay, calls, late);
  }
  using Did = std::vector<std::string>;
  Did did_;
};

TEST_F(TickClockTest, WaitsForTheClockAndBeginsWithTheTickThatItShows) {
  TickClock clock = make();
  clock.see(0);
  EXPECT_FALSE(clock.hasBegun());
  EXPECT_EQ(did_, Did());
  clock.see(UNIX + SECOND / 4);
  EXPECT_EQ(did_, (Did{"before", "17000000002"}));
  EXPECT_EQ(clock.tick(), 17000000002);
  EXPECT_EQ(clock.stamp(), UNIX + SECOND / 5);
}

TEST_F(TickClockTest, DoesEachTickOnceAndCatchesUpForASecond) {
  TickClock clock = make();
  clock.see(5 * SECOND);
  clock.see(5 * SECOND);
  clock.see(5 * SECOND + SECOND / 20);
  EXPECT_EQ(did_, (Did{"before", "50"}));
  clock.see(6 * SECOND);
  EXPECT_EQ(did_, (Did{"before", "50", "before", "51", "52", "53", "54", "55", "56", "57", "58",
                       "59", "60"}));
  EXPECT_EQ(clock.counts().ticks, 11u);
  EXPECT_EQ(clock.counts().dropped, 0u);
}

TEST_F(TickClockTest, DropsAndCountsTicksThatAJumpSkips) {
  TickClock clock = make();
  clock.see(5 * SECOND);
  clock.see(6 * SECOND + SECOND / 10);
  EXPECT_EQ(did_, (Did{"before", "50", "before", "61"}));
  EXPECT_EQ(clock.counts().dropped, 10u);
  EXPECT_EQ(clock.counts().ticks, 2u);
}

TEST_F(TickClockTest, ALatestOnlyClockDropsAndCountsEarlierTicks) {
  TickClock clock = make(0.0, LateTicks::NEWEST);
  clock.see(5 * SECOND);
  clock.see(5 * SECOND + SECOND / 10);
  EXPECT_EQ(clock.counts().dropped, 0u);
  clock.see(5 * SECOND + SECOND / 2);
  EXPECT_EQ(did_, (Did{"before", "50", "before", "51", "before", "55"}));
  EXPECT_EQ(clock.counts().dropped, 3u);
  EXPECT_EQ(clock.counts().ticks, 3u);
  clock.see(4 * SECOND);
  EXPECT_EQ(did_.back(), "40");
  EXPECT_EQ(clock.counts().dropped, 3u);
}

TEST_F(TickClockTest, AJumpBackIsAFreshStart) {
  TickClock clock = make();
  clock.see(5 * SECOND);
  clock.see(5 * SECOND - BackwardStep::LARGEST_STEP - 1);
  EXPECT_EQ(did_, (Did{"before", "50", "back to 4", "before", "48"}));
  EXPECT_EQ(clock.counts().jumps, 1u);
  EXPECT_EQ(clock.counts().dropped, 0u);
  clock.see(5 * SECOND);
  EXPECT_EQ(did_.back(), "50");
}

// A step of time synchronisation does not end what people have built.
TEST_F(TickClockTest, NoTickRunsUntilASmallStepBackIsMadeUp) {
  TickClock clock = make();
  clock.see(5 * SECOND);
  clock.see(5 * SECOND - BackwardStep::LARGEST_STEP);
  clock.see(5 * SECOND - 1);
  EXPECT_EQ(did_, (Did{"before", "50"}));
  clock.see(5 * SECOND + SECOND / 10);
  EXPECT_EQ(did_, (Did{"before", "50", "before", "51"}));
  EXPECT_EQ(clock.counts().jumps, 0u);
  EXPECT_EQ(clock.counts().dropped, 0u);
}

// Steps add up to a jump: they are measured from the newest time.
TEST_F(TickClockTest, AClockThatRunsBackwardsIsAJump) {
  TickClock clock = make();
  for (int i = 0; i < 4; ++i) clock.see(5 * SECOND - i * SECOND / 25);
  EXPECT_EQ(clock.counts().jumps, 1u);
}

TEST_F(TickClockTest, ADelayedClockStaysBehind) {
  TickClock clock = make(0.5);
  clock.see(SECOND / 2);
  EXPECT_FALSE(clock.hasBegun());
  clock.see(5 * SECOND);
  EXPECT_EQ(did_, (Did{"before", "45"}));
}

// The restarted node may ask for the clock, because its time has not begun.
TEST_F(TickClockTest, HasNotBegunWhileItRestarts) {
  TickClock* seen = nullptr;
  bool begun = true;
  TickCalls calls;
  calls.tick = [](std::int64_t) {};
  calls.back = [&](Nanoseconds) { begun = seen->hasBegun(); };
  TickClock clock("node", 10, 0.0, calls);
  seen = &clock;
  clock.see(5 * SECOND);
  clock.see(SECOND);
  EXPECT_FALSE(begun);
  EXPECT_TRUE(clock.hasBegun());
}

}  // namespace
}  // namespace vegetation_sim

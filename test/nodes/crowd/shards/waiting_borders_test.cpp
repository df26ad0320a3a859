// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/shards/waiting_borders.h"

#include <gtest/gtest.h>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = 10000000;
constexpr Shard FIRST_OF_TWO{0, 2};

// The border after tick `tick` holds the byte `tick`.
CrowdBorder borderAfter(std::uint8_t tick, std::uint32_t shard = 1, std::uint32_t shards = 2) {
  CrowdBorder out;
  out.header.stamp = toStamp(tick * TICK);
  out.shard = shard;
  out.shards = shards;
  out.border = {tick};
  if (tick == 0) return out;
  out.previous_stamp = toStamp((tick - 1) * TICK);
  out.previous_border = {std::uint8_t(tick - 1)};
  return out;
}

std::vector<int> ticksOf(const std::vector<CrowdBorder>& borders) {
  std::vector<int> out;
  for (const CrowdBorder& one : borders) out.push_back(one.border.at(0));
  return out;
}

std::vector<CrowdBorder> takeAt(WaitingBorders& borders, Nanoseconds now) {
  borders.beginTick(0, now);
  return borders.take();
}

bool hasAllAt(WaitingBorders& borders, Nanoseconds before) {
  borders.beginTick(before, before + TICK);
  return borders.hasAll();
}

std::size_t dropLateAt(WaitingBorders& borders, Nanoseconds before) {
  borders.beginTick(before, before + TICK);
  return borders.dropLate();
}

TEST(WaitingBorders, ATickTakesTheNewestThatIsEarlier) {
  WaitingBorders borders(FIRST_OF_TWO);
  for (const int tick : {1, 2, 3}) borders.add(borderAfter(std::uint8_t(tick)));
  EXPECT_EQ(ticksOf(takeAt(borders, 3 * TICK)), std::vector<int>{2});
  EXPECT_EQ(ticksOf(takeAt(borders, 4 * TICK)), std::vector<int>{3});
  EXPECT_TRUE(takeAt(borders, 5 * TICK).empty());
}

// The other shard was one tick ahead when the link came up.
TEST(WaitingBorders, TheFirstMessageMayBeOfTheTickThatBegins) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(62));
  EXPECT_TRUE(hasAllAt(borders, 61 * TICK));
  const std::vector<CrowdBorder> taken = takeAt(borders, 62 * TICK);
  EXPECT_EQ(ticksOf(taken), std::vector<int>{61});
  // It is the message that tick 61 has sent, but for what that held of tick 60.
  EXPECT_EQ(taken.at(0).header.stamp, toStamp(61 * TICK));
  EXPECT_TRUE(taken.at(0).previous_border.empty());
  EXPECT_EQ(ticksOf(takeAt(borders, 63 * TICK)), std::vector<int>{62});
}

TEST(WaitingBorders, AShardThatIsAheadHasRunBefore) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(62));
  takeAt(borders, 62 * TICK);
  EXPECT_FALSE(borders.isAnyAhead());
  takeAt(borders, 61 * TICK);
  EXPECT_TRUE(borders.isAnyAhead());
}

TEST(WaitingBorders, ABorderIsTakenOnce) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(7));
  EXPECT_EQ(ticksOf(takeAt(borders, 8 * TICK)), std::vector<int>{7});
  borders.add(borderAfter(8));  // holds 7 too
  EXPECT_TRUE(takeAt(borders, 8 * TICK).empty());
  EXPECT_EQ(ticksOf(takeAt(borders, 9 * TICK)), std::vector<int>{8});
}

TEST(WaitingBorders, ASilentShardIsExpectedAgainOnceItSends) {
  WaitingBorders borders(FIRST_OF_TWO);
  EXPECT_FALSE(hasAllAt(borders, TICK));
  EXPECT_EQ(dropLateAt(borders, TICK), 1u);
  EXPECT_TRUE(hasAllAt(borders, TICK));
  borders.add(borderAfter(3));
  EXPECT_TRUE(hasAllAt(borders, 3 * TICK));
  EXPECT_FALSE(hasAllAt(borders, 4 * TICK));
  EXPECT_EQ(dropLateAt(borders, 3 * TICK), 0u);
}

TEST(WaitingBorders, OtherMessagesAreIgnored) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(3, 0));     // its own
  borders.add(borderAfter(3, 2));     // of no shard
  borders.add(borderAfter(3, 1, 3));  // of three
  EXPECT_FALSE(hasAllAt(borders, TICK));
  EXPECT_TRUE(takeAt(borders, 9 * TICK).empty());
}

TEST(WaitingBorders, AMessageWhoseOrderIsWrongGivesItsBorderOnly) {
  WaitingBorders borders(FIRST_OF_TWO);
  CrowdBorder wrong = borderAfter(5);
  wrong.previous_stamp = toStamp(6 * TICK);
  borders.add(wrong);
  EXPECT_EQ(ticksOf(takeAt(borders, 9 * TICK)), std::vector<int>{5});
}

// The other shard sees the jump after this one: its borders from before are void, and awaited anew.
TEST(WaitingBorders, AfterAJumpBackThoseFromBeforeAreVoid) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(100));
  borders.beginTick(100 * TICK, 101 * TICK);
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{100});
  borders.add(borderAfter(101));
  borders.jumpBack();
  borders.beginTick(0, 51 * TICK);
  EXPECT_FALSE(borders.hasAll());
  borders.add(borderAfter(102));
  EXPECT_FALSE(borders.hasAll());
  EXPECT_TRUE(borders.take().empty());
  borders.add(borderAfter(0));
  EXPECT_TRUE(borders.hasAll());
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{0});
  borders.add(borderAfter(51));
  borders.beginTick(51 * TICK, 52 * TICK);
  EXPECT_TRUE(borders.hasAll());
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{51});
}

// The other shard sees the jump before this one: this one's tick still has the border from before.
TEST(WaitingBorders, ThoseFromAfterAJumpBackWaitForIt) {
  WaitingBorders borders(FIRST_OF_TWO);
  for (const int tick : {99, 100, 0, 51}) {
    borders.beginTick(99 * TICK, 100 * TICK);
    borders.add(borderAfter(std::uint8_t(tick)));
  }
  borders.beginTick(100 * TICK, 101 * TICK);
  EXPECT_TRUE(borders.hasAll());
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{100});
  borders.jumpBack();
  borders.beginTick(0, 51 * TICK);
  EXPECT_TRUE(borders.hasAll());
  // What the shard has sent after tick 51 is for the tick after that.
  EXPECT_LT(borders.take().at(0).header.stamp, toStamp(51 * TICK));
  borders.beginTick(51 * TICK, 52 * TICK);
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{51});
}

TEST(WaitingBorders, AStampAheadDoesNotReplaceTrueOnes) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.beginTick(TICK, 2 * TICK);
  borders.add(borderAfter(1));
  for (const double ahead : {1.0, 11.0, 1e9}) {
    CrowdBorder wrong = borderAfter(200);
    wrong.header.stamp = toStamp(2 * TICK + fromSeconds(ahead));
    wrong.previous_border.clear();
    borders.add(wrong);
  }
  EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{1});
  for (const int tick : {2, 3, 4}) {
    borders.beginTick(tick * TICK, (tick + 1) * TICK);
    borders.add(borderAfter(std::uint8_t(tick)));
    EXPECT_EQ(ticksOf(borders.take()), std::vector<int>{tick}) << tick;
  }
  // One that is too far ahead is not taken for a sign of life.
  borders.beginTick(5 * TICK, 6 * TICK);
  CrowdBorder wrong = borderAfter(200);
  wrong.header.stamp = toStamp(6 * TICK + fromSeconds(11.0));
  borders.add(wrong);
  EXPECT_FALSE(borders.hasAll());
}

TEST(WaitingBorders, AFloodKeepsTheLast) {
  WaitingBorders borders(FIRST_OF_TWO);
  for (int tick = 0; tick < 250; ++tick) borders.add(borderAfter(std::uint8_t(tick)));
  EXPECT_TRUE(takeAt(borders, 140 * TICK).empty());
  EXPECT_EQ(ticksOf(takeAt(borders, 151 * TICK)), std::vector<int>{150});
}

// A border of that many bytes, which message has no border of the tick before.
CrowdBorder largeBorder(std::uint8_t tick, std::uint32_t shard, std::size_t bytes) {
  CrowdBorder out = borderAfter(tick, shard, 3);
  out.border.assign(bytes, tick);
  out.previous_border.clear();
  return out;
}

// The shard with most bytes loses its oldest borders, and the others lose none.
TEST(WaitingBorders, LargeOnesAreDroppedAndCounted) {
  WaitingBorders borders({0, 3}, 1000);
  borders.beginTick(TICK, 2 * TICK);
  borders.add(largeBorder(1, 1, 300));
  for (const int tick : {1, 2, 3, 4}) borders.add(largeBorder(std::uint8_t(tick), 2, 200));
  EXPECT_EQ(borders.dropped(), 1u);
  EXPECT_EQ(ticksOf(takeAt(borders, 2 * TICK)), std::vector<int>{1});  // of shard 1
  EXPECT_EQ(ticksOf(takeAt(borders, 5 * TICK)), std::vector<int>{4});  // of shard 2
  borders.beginTick(5 * TICK, 6 * TICK);
  borders.add(largeBorder(5, 1, 1001));
  EXPECT_EQ(borders.dropped(), 2u);
  EXPECT_TRUE(takeAt(borders, 9 * TICK).empty());
}

// Nor are those without limit that come before this node sees a jump of the clock.
TEST(WaitingBorders, LargeOnesFromAfterAJumpAreDroppedToo) {
  WaitingBorders borders({0, 3}, 1000);
  borders.beginTick(99 * TICK, 100 * TICK);
  borders.add(largeBorder(99, 1, 10));
  for (const int tick : {1, 2, 3, 4}) borders.add(largeBorder(std::uint8_t(tick), 1, 300));
  EXPECT_EQ(borders.dropped(), 1u);
  borders.jumpBack();
  EXPECT_TRUE(takeAt(borders, 2 * TICK).empty());
  EXPECT_EQ(ticksOf(takeAt(borders, 5 * TICK)), std::vector<int>{4});
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/waiting_borders.h"

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

TEST(WaitingBorders, ATickTakesTheNewestThatIsEarlier) {
  WaitingBorders borders(FIRST_OF_TWO);
  for (const int tick : {1, 2, 3}) borders.add(borderAfter(std::uint8_t(tick)));
  EXPECT_EQ(ticksOf(borders.take(3 * TICK)), std::vector<int>{2});
  EXPECT_EQ(ticksOf(borders.take(4 * TICK)), std::vector<int>{3});
  EXPECT_TRUE(borders.take(5 * TICK).empty());
}

// The other shard was one tick ahead when the link came up.
TEST(WaitingBorders, TheFirstMessageMayBeOfTheTickThatBegins) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(62));
  EXPECT_TRUE(borders.hasAll(61 * TICK));
  const std::vector<CrowdBorder> taken = borders.take(62 * TICK);
  EXPECT_EQ(ticksOf(taken), std::vector<int>{61});
  // It is the message that tick 61 has sent, but for what that held of tick 60.
  EXPECT_EQ(taken.at(0).header.stamp, toStamp(61 * TICK));
  EXPECT_TRUE(taken.at(0).previous_border.empty());
  EXPECT_EQ(ticksOf(borders.take(63 * TICK)), std::vector<int>{62});
}

TEST(WaitingBorders, ABorderIsTakenOnce) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(7));
  EXPECT_EQ(ticksOf(borders.take(8 * TICK)), std::vector<int>{7});
  borders.add(borderAfter(8));  // holds 7 too
  EXPECT_TRUE(borders.take(8 * TICK).empty());
  EXPECT_EQ(ticksOf(borders.take(9 * TICK)), std::vector<int>{8});
}

TEST(WaitingBorders, ASilentShardIsExpectedAgainOnceItSends) {
  WaitingBorders borders(FIRST_OF_TWO);
  EXPECT_FALSE(borders.hasAll(TICK));
  EXPECT_EQ(borders.dropLate(TICK), 1u);
  EXPECT_TRUE(borders.hasAll(TICK));
  borders.add(borderAfter(3));
  EXPECT_TRUE(borders.hasAll(3 * TICK));
  EXPECT_FALSE(borders.hasAll(4 * TICK));
  EXPECT_EQ(borders.dropLate(3 * TICK), 0u);
}

TEST(WaitingBorders, OtherMessagesAreIgnored) {
  WaitingBorders borders(FIRST_OF_TWO);
  borders.add(borderAfter(3, 0));     // its own
  borders.add(borderAfter(3, 2));     // of no shard
  borders.add(borderAfter(3, 1, 3));  // of three
  EXPECT_FALSE(borders.hasAll(TICK));
  EXPECT_TRUE(borders.take(9 * TICK).empty());
}

TEST(WaitingBorders, AMessageWhoseOrderIsWrongGivesItsBorderOnly) {
  WaitingBorders borders(FIRST_OF_TWO);
  CrowdBorder wrong = borderAfter(5);
  wrong.previous_stamp = toStamp(6 * TICK);
  borders.add(wrong);
  EXPECT_EQ(ticksOf(borders.take(9 * TICK)), std::vector<int>{5});
}

TEST(WaitingBorders, AFloodKeepsTheLast) {
  WaitingBorders borders(FIRST_OF_TWO);
  for (int tick = 0; tick < 250; ++tick) borders.add(borderAfter(std::uint8_t(tick)));
  EXPECT_TRUE(borders.take(140 * TICK).empty());
  EXPECT_EQ(ticksOf(borders.take(151 * TICK)), std::vector<int>{150});
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

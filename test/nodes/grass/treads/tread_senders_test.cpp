// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/treads/tread_senders.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr Nanoseconds AHEAD = 6;  // of the treads of a message

TEST(TreadSenders, EachWhoSaysSoIsAwaited) {
  TreadSenders senders;
  EXPECT_TRUE(senders.areComplete(100));
  EXPECT_TRUE(senders.hear("robot", 100, 0, 100));
  EXPECT_TRUE(senders.areComplete(1000));  // it does not say when it sends
  EXPECT_TRUE(senders.hear("crowd_0", 100, 100 + AHEAD, 100));
  EXPECT_TRUE(senders.hear("crowd_1", 99, 99 + AHEAD, 100));
  EXPECT_TRUE(senders.areComplete(99 + AHEAD));
  EXPECT_FALSE(senders.areComplete(100 + AHEAD));
  EXPECT_TRUE(senders.hear("crowd_1", 100, 100 + AHEAD, 100));
  EXPECT_TRUE(senders.areComplete(100 + AHEAD));
}

TEST(TreadSenders, OneWhoIsLateIsAwaitedAgainOnceItSends) {
  TreadSenders senders;
  senders.hear("crowd", 100, 100, 100);
  senders.hear("hanging", 90, 90, 100);
  EXPECT_EQ(senders.endWait(100), 1U);
  EXPECT_TRUE(senders.areComplete(100));
  EXPECT_FALSE(senders.areComplete(101));
  senders.hear("crowd", 101, 101, 101);
  EXPECT_TRUE(senders.areComplete(101));
  senders.hear("hanging", 91, 91, 101);
  EXPECT_FALSE(senders.areComplete(101));
  EXPECT_EQ(senders.endWait(101), 1U);
  senders.hear("crowd", 110, 110, 110);
  senders.hear("hanging", 92, 92, 101);  // now the second message counts
  EXPECT_TRUE(senders.areComplete(110));
  senders.hear("hanging", 93, 93, 101);
  EXPECT_FALSE(senders.areComplete(110));
  senders.hear("hanging", 110, 110, 110);
  EXPECT_EQ(senders.endWait(110), 0U);
  EXPECT_EQ(senders.endWait(111), 2U);
  senders.hear("hanging", 111, 111, 111);  // it was in time, so the next one counts
  EXPECT_FALSE(senders.areComplete(112));
}

TEST(TreadSenders, MessagesFromBeforeAJumpBackAreVoid) {
  TreadSenders senders;
  senders.hear("robot", 100, 0, 100);
  senders.hear("crowd", 100, 100 + AHEAD, 100);
  senders.jumpBack();
  EXPECT_FALSE(senders.areComplete(10));
  EXPECT_FALSE(senders.hear("crowd", 101, 101 + AHEAD, 10));
  EXPECT_FALSE(senders.areComplete(10));
  EXPECT_TRUE(senders.hear("crowd", 10, 10 + AHEAD, 10));
  EXPECT_TRUE(senders.areComplete(10));
  EXPECT_FALSE(senders.hear("robot", 101, 0, 10));
  EXPECT_TRUE(senders.hear("robot", 10, 0, 10));
  EXPECT_TRUE(senders.hear("crowd", 11, 11 + AHEAD, 10));  // ahead of this node, which lags behind
}

TEST(TreadSenders, OneWhoIsLateAndJumpsBackIsNotAwaitedUntilItSends) {
  TreadSenders senders;
  senders.hear("crowd", 100, 100, 100);
  senders.endWait(101);
  senders.jumpBack();
  EXPECT_TRUE(senders.areComplete(10));
  EXPECT_FALSE(senders.hear("crowd", 101, 101, 10));
  EXPECT_TRUE(senders.areComplete(10));
  EXPECT_TRUE(senders.hear("crowd", 10, 10, 10));
  EXPECT_FALSE(senders.areComplete(11));
}

TEST(TreadSenders, MessagesFromBeforeALoadAreVoid) {
  TreadSenders senders;
  senders.hear("crowd", 99, 99 + AHEAD, 100);
  EXPECT_TRUE(senders.haveSent(99));
  EXPECT_FALSE(senders.haveSent(100));
  senders.onLoaded(100);
  EXPECT_FALSE(senders.hear("crowd", 100, 100 + AHEAD, 101));
  EXPECT_TRUE(senders.hear("robot", 100, 0, 101));  // which nobody awaits, so it is no part of that
  EXPECT_TRUE(senders.hear("crowd", 101, 101 + AHEAD, 101));
  senders.jumpBack();
  EXPECT_TRUE(senders.hear("crowd", 10, 10 + AHEAD, 10));
}

TEST(TreadSenders, TooManyAreNotAwaited) {
  TreadSenders senders;
  for (std::size_t i = 0; i < TreadSenders::MOST_SENDERS; ++i)
    senders.hear("crowd_" + std::to_string(i), 100, 100, 100);
  EXPECT_TRUE(senders.hear("one_more", 90, 90, 100));
  EXPECT_TRUE(senders.areComplete(100));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

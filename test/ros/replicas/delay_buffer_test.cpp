// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/delay_buffer.h"

#include <gtest/gtest.h>

#include <vector>

namespace vegetation_sim {
namespace {

std::vector<int> take(DelayBuffer<int>& buffer, Nanoseconds stamp) {
  std::vector<int> out;
  buffer.take(stamp, [&](Nanoseconds, int message) { out.push_back(message); });
  return out;
}

TEST(DelayBuffer, MessagesWaitForTheirStampsInTheOrderOfArrival) {
  DelayBuffer<int> buffer;
  for (int i = 1; i <= 4; ++i) buffer.add(10 * i, 1, i);
  EXPECT_EQ(take(buffer, 25), (std::vector<int>{1, 2}));
  buffer.forgetLater(30);
  EXPECT_EQ(take(buffer, 100), (std::vector<int>{3}));
}

// One message with a wrong stamp must not stop all others.
TEST(DelayBuffer, AMessageOfAFarFutureHoldsBackNoOther) {
  DelayBuffer<int> buffer;
  buffer.add(1000000, 1, 9);
  for (int i = 1; i <= 3; ++i) buffer.add(10 * i, 1, i);
  EXPECT_EQ(take(buffer, 30), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(buffer.size(), 1u);
  EXPECT_EQ(take(buffer, 1000000), (std::vector<int>{9}));
}

TEST(DelayBuffer, TheLatestIsDroppedAndCountedIfTooManyWait) {
  constexpr int MOST = DelayBuffer<int>::MOST_WAITING;
  DelayBuffer<int> buffer;
  for (int i = MOST + 2; i > 0; --i) buffer.add(i, 1, i);
  EXPECT_EQ(buffer.lost(), 2u);
  const std::vector<int> taken = take(buffer, MOST + 2);
  ASSERT_EQ(taken.size(), std::size_t{MOST});
  EXPECT_EQ(taken.front(), MOST);
  EXPECT_EQ(taken.back(), 1);
}

// Large messages for later neither need more memory nor push out what is due before them.
TEST(DelayBuffer, TheLatestAreDroppedAndCountedIfTheyAreTooLarge) {
  constexpr std::size_t MOST = DelayBuffer<int>::MOST_BYTES;
  DelayBuffer<int> buffer;
  buffer.add(1, 1, 1);
  for (int i = 2; i <= 6; ++i) buffer.add(i, MOST / 4, i);
  EXPECT_EQ(buffer.lost(), 2u);
  EXPECT_EQ(take(buffer, 3), (std::vector<int>{1, 2, 3}));
  buffer.add(5, MOST / 2, 5);
  buffer.add(5, MOST / 2, 6);
  EXPECT_EQ(buffer.lost(), 3u);
  buffer.forgetLater(4);
  EXPECT_EQ(buffer.size(), 1u);
  buffer.add(5, MOST / 2, 7);
  buffer.add(4, MOST + 1, 8);
  EXPECT_EQ(buffer.lost(), 5u);
  EXPECT_EQ(take(buffer, 9), (std::vector<int>{4}));
}

}  // namespace
}  // namespace vegetation_sim

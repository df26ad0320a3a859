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
  for (int i = 1; i <= 4; ++i) buffer.add(10 * i, i);
  EXPECT_EQ(take(buffer, 25), (std::vector<int>{1, 2}));
  buffer.forgetLater(30);
  EXPECT_EQ(take(buffer, 100), (std::vector<int>{3}));
}

// One message with a wrong stamp must not stop all others.
TEST(DelayBuffer, AMessageOfAFarFutureHoldsBackNoOther) {
  DelayBuffer<int> buffer;
  buffer.add(1000000, 9);
  for (int i = 1; i <= 3; ++i) buffer.add(10 * i, i);
  EXPECT_EQ(take(buffer, 30), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(buffer.size(), 1u);
  EXPECT_EQ(take(buffer, 1000000), (std::vector<int>{9}));
}

TEST(DelayBuffer, TheOldestIsDroppedAndCountedIfTooManyWait) {
  DelayBuffer<int> buffer;
  for (std::size_t i = 0; i < DelayBuffer<int>::MOST_WAITING + 2; ++i)
    buffer.add(1, static_cast<int>(i));
  EXPECT_EQ(buffer.lost(), 2u);
  EXPECT_EQ(take(buffer, 1).front(), 2);
}

}  // namespace
}  // namespace vegetation_sim

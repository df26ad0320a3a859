// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/key_frames.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr int RATE = 30, BUDGET = 100000;

/// Returns the bytes per second of key frames of one size over ten minutes.
double bytesPerSecond(KeyFrames& frames, std::uint64_t size) {
  constexpr int SECONDS = 600;
  double sum = 0.0;
  for (std::int64_t tick = 1; tick <= RATE * SECONDS; ++tick) {
    if (!frames.isDue(tick)) continue;
    sum += static_cast<double>(size);
    frames.sent(size);
  }
  return sum / SECONDS;
}

TEST(KeyFrames, HaveTheRequestedPeriodWhileTheyAreSmall) {
  KeyFrames frames(2.0, RATE, BUDGET);
  EXPECT_TRUE(frames.isDue(7));  // The first one is due at once.
  frames.sent(200000);
  for (std::int64_t tick = 8; tick < 200; ++tick) EXPECT_EQ(frames.isDue(tick), tick % 60 == 0);
  EXPECT_EQ(frames.period(), 2.0);
  EXPECT_EQ(frames.balance().held_back, 0u);
}

// N7: the rate stays within the budget for a state of up to 128 times the size.
TEST(KeyFrames, KeepToTheirBudget) {
  for (const std::uint64_t size : {150000, 250000, 1000000, 20000000}) {
    KeyFrames frames(2.0, RATE, BUDGET);
    EXPECT_LE(bytesPerSecond(frames, size), 1.1 * BUDGET + static_cast<double>(size) / 600.0);
    EXPECT_EQ(frames.balance().held_back > 0, size > 2 * BUDGET) << size;
    EXPECT_GT(2.0 * frames.balance().cost, size > 2 * BUDGET ? BUDGET : 0.0) << size;
    EXPECT_EQ(frames.balance().wanted, static_cast<double>(size) / 2.0);
  }
}

TEST(KeyFrames, ComeMoreOftenAgainWhenTheStateIsSmaller) {
  KeyFrames frames(2.0, RATE, BUDGET);
  frames.sent(1000000);
  EXPECT_EQ(frames.period(), 16.0);
  frames.sent(10000);
  EXPECT_EQ(frames.period(), 2.0);
}

// Late subscribers do not wait.
TEST(KeyFrames, AreSentOnDemand) {
  KeyFrames frames(2.0, RATE, BUDGET);
  frames.isDue(1);
  frames.sent(100000000);
  EXPECT_FALSE(frames.isDue(60));
  frames.demand();
  EXPECT_TRUE(frames.isDue(61));
  EXPECT_FALSE(frames.isDue(62));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/landscape/near_choice.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr Nanoseconds SECOND = NANOSECONDS_PER_SECOND;

TEST(NearChoiceTest, TheWholeIsReceivedUntilTheNearInputHasHadAllForASecond) {
  NearChoice choice;
  EXPECT_TRUE(choice.needsWhole(10 * SECOND));
  choice.choose(false, 9 * SECOND, 9 * SECOND, 10 * SECOND);
  EXPECT_FALSE(choice.isNear());
  choice.choose(true, 10 * SECOND, 10 * SECOND, 11 * SECOND - 1);
  EXPECT_TRUE(choice.isNear());
  EXPECT_TRUE(choice.needsWhole(11 * SECOND - 1));
  EXPECT_FALSE(choice.needsWhole(11 * SECOND));
}

TEST(NearChoiceTest, TheNewerInputIsUsedAlsoIfItLacksSomething) {
  NearChoice choice;
  choice.choose(true, 9 * SECOND, 10 * SECOND, 10 * SECOND);
  EXPECT_FALSE(choice.isNear());
  EXPECT_TRUE(choice.isComplete());
  choice.choose(false, 10 * SECOND, 9 * SECOND, 10 * SECOND);
  EXPECT_TRUE(choice.isNear());
  EXPECT_FALSE(choice.isComplete());
}

TEST(NearChoiceTest, TheWholeIsReceivedAgainOnceTheNearInputLacksSomething) {
  NearChoice choice;
  choice.choose(true, 10 * SECOND, 10 * SECOND, 10 * SECOND);
  EXPECT_FALSE(choice.needsWhole(12 * SECOND));
  EXPECT_TRUE(choice.isComplete());
  choice.choose(false, 12 * SECOND, 11 * SECOND, 12 * SECOND);
  EXPECT_FALSE(choice.isComplete());
  EXPECT_TRUE(choice.needsWhole(12 * SECOND));
  choice.choose(false, 12 * SECOND, 12 * SECOND, 12 * SECOND + 1);
  EXPECT_TRUE(choice.isComplete());
  choice.reset();
  EXPECT_TRUE(choice.needsWhole(100 * SECOND));
}

}  // namespace
}  // namespace vegetation_sim

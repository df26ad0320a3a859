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
  EXPECT_FALSE(choice.choose(false, true, 10 * SECOND));
  EXPECT_TRUE(choice.choose(true, true, 11 * SECOND - 1));
  EXPECT_TRUE(choice.needsWhole(11 * SECOND - 1));
  EXPECT_FALSE(choice.needsWhole(11 * SECOND));
}

TEST(NearChoiceTest, TheWholeIsReceivedAgainOnceTheNearInputLacksSomething) {
  NearChoice choice;
  choice.choose(true, true, 10 * SECOND);
  EXPECT_FALSE(choice.needsWhole(12 * SECOND));
  EXPECT_TRUE(choice.isComplete());
  choice.choose(false, false, 12 * SECOND);
  EXPECT_FALSE(choice.isComplete());
  EXPECT_TRUE(choice.needsWhole(12 * SECOND));
  choice.choose(false, true, 12 * SECOND + 1);
  EXPECT_TRUE(choice.isComplete());
  choice.reset();
  EXPECT_TRUE(choice.needsWhole(100 * SECOND));
}

}  // namespace
}  // namespace vegetation_sim

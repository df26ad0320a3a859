// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/tier_allocation.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

// Returns an item whose tiers cost 0, 1, 2 ... and have errors of 8, 4, 2 ... times `scale`.
TierChoice choiceOf(double scale, int wanted, int stepwise = MAX_TIERS) {
  TierChoice out;
  out.stepwise = std::min(stepwise, wanted);
  out.wanted = wanted;
  for (std::size_t tier = 0; tier < MAX_TIERS; ++tier) {
    out.error[tier] = static_cast<float>(scale * 8.0 / static_cast<double>(1 << tier));
    out.cost[tier] = static_cast<float>(tier);
  }
  return out;
}

// N7: the tiers that the tolerance asks for are chosen while there is room for them.
TEST(Governor, TakesTheCheapestTiersThatHoldTheTolerance) {
  std::vector<TierChoice> choices{choiceOf(1.0, 3), choiceOf(0.5, 2), choiceOf(9.0, 7, 4)};
  const TierAllocation balance = allocateTiers(choices, 100.0, 1.0);
  EXPECT_EQ(choices[0].chosen, 3);
  EXPECT_EQ(choices[1].chosen, 2);
  EXPECT_EQ(choices[2].chosen, 7);
  EXPECT_DOUBLE_EQ(balance.cost, 3.0 + 2.0 + 7.0);
  EXPECT_EQ(balance.held_back, 0u);
}

// N7: when the budget binds, the largest error per cost is removed first, and the remaining errors
// are about equal.
TEST(Governor, LargestErrorPerCostGoesFirst) {
  std::vector<TierChoice> choices;
  for (int i = 0; i < 8; ++i) choices.push_back(choiceOf(i < 4 ? 1.0 : 4.0, 6));
  const TierAllocation balance = allocateTiers(choices, 24.0, 0.1);
  EXPECT_LE(balance.cost, 24.0);
  EXPECT_GE(balance.cost, 0.9 * 24.0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(choices[4 + i].chosen, choices[i].chosen + 2);
  EXPECT_EQ(balance.held_back, 8u);
}

// Where there is no room for the wanted tier above `stepwise`, the one before it is chosen.
TEST(Governor, TiersAboveTheStepwiseOnesAreClimbedOneByOne) {
  TierChoice choice = choiceOf(1.0, 8, 3);
  choice.above = 7;
  for (const auto& [room, chosen] : {std::pair{8.0, 8}, {7.5, 7}, {6.5, 3}}) {
    std::vector<TierChoice> choices{choice};
    allocateTiers(choices, room, 0.01);
    EXPECT_EQ(choices[0].chosen, chosen) << room;
  }
  choice.above = 8;
  std::vector<TierChoice> choices{choice};
  allocateTiers(choices, 7.5, 0.01);
  EXPECT_EQ(choices[0].chosen, 3);
}

// N7: no limit cycle: items whose priorities differ by less than STICKY do not alternate.
TEST(Governor, WhatIsHeldStays) {
  std::vector<TierChoice> choices;
  for (int i = 0; i < 20; ++i) choices.push_back(choiceOf(1.0 + 0.01 * i, 4));
  allocateTiers(choices, 41.0, 0.1);
  const std::vector<TierChoice> before = choices;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    choices[i].held = before[i].chosen;
    for (float& error : choices[i].error) error *= i % 2 ? 0.9f : 1.1f;
  }
  allocateTiers(choices, 41.0, 0.1);
  for (std::size_t i = 0; i < choices.size(); ++i) EXPECT_EQ(choices[i].chosen, before[i].chosen);
}

TEST(Governor, WhatHasJustChangedRests) {
  std::vector<TierChoice> choices{choiceOf(1.0, 4), choiceOf(9.0, 4)};
  choices[0].resting = true;
  choices[0].held = 3;
  allocateTiers(choices, 4.0, 0.1);
  EXPECT_EQ(choices[0].chosen, 3);
  EXPECT_EQ(choices[1].chosen, 1);
}

TEST(Governor, AFinerTierIsKeptUntilTheCoarserOneIsWellWithin) {
  TierChoice choice = choiceOf(1.0, 0);
  EXPECT_EQ(tierWithin(choice, 7, 1.0), 3);
  EXPECT_EQ(tierWithin(choice, 2, 1.0), 2);  // none holds it, so the finest is chosen
  choice.held = 4;                           // tier 3 has an error of 1.0
  EXPECT_EQ(tierWithin(choice, 7, 1.2), 4);
  EXPECT_EQ(tierWithin(choice, 7, 1.5), 3);
}

// N9: errors in pixels are lengths at their items, of which a far one may be the largest.
TEST(TierAllocation, ReportsTheLargestErrorAsALength) {
  std::vector<TierChoice> choices(3);
  const float errors[] = {4.f, 2.f, 9.f};
  const double scales[] = {100.0, 10.0, 0.0};  // the last one is not known
  for (std::size_t i = 0; i < 3; ++i) {
    choices[i].error[0] = errors[i];
    choices[i].scale = scales[i];
  }
  const TierAllocation out = allocateTiers(choices, 10.0, 20.0);
  EXPECT_EQ(out.largest, 9.0);
  EXPECT_DOUBLE_EQ(out.largest_metres, 0.2);
}

}  // namespace
}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/tier_hysteresis.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int FINEST = 3;

/// Items with ids 10, 20 ... whose tiers cost 0, 1, 2, 3 and have errors of 8, 4, 2, 1 times their
/// size.
struct Things {
  const std::vector<TierChoice>& choose(const std::vector<double>& sizes, double room,
                                        double tolerance, double seconds) {
    choices.clear();
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      TierChoice choice;
      choice.id = static_cast<std::uint32_t>(10 * (i + 1));
      for (std::size_t tier = 0; tier <= FINEST; ++tier) {
        choice.error[tier] = static_cast<float>(sizes[i] * 8.0 / (1 << tier));
        choice.cost[tier] = static_cast<float>(tier);
      }
      if (sizes[i] > 0.0) choices.push_back(choice);  // 0: the item is absent
    }
    held.allocateTiers(choices, FINEST, room, tolerance, START + fromSeconds(seconds));
    return choices;
  }
  TierHysteresis held;
  std::vector<TierChoice> choices;
};

// N7: an item that has changed keeps its tier for a second while the budget binds, whatever the
// others do.
TEST(TierHysteresis, WhatHasChangedRests) {
  Things things;
  things.choose({1.0, 0.1}, 3.0, 0.1, 0.0);
  ASSERT_EQ(things.choices[0].chosen, FINEST);
  things.choose({1.0, 9.0}, 3.0, 0.1, 0.9);
  EXPECT_TRUE(things.choices[0].resting);
  EXPECT_FALSE(things.choices[1].resting);  // never had more
  EXPECT_EQ(things.choices[0].chosen, FINEST);
  things.choose({1.0, 9.0}, 3.0, 0.1, 1.1);
  EXPECT_FALSE(things.choices[0].resting);
  EXPECT_LT(things.choices[0].chosen, FINEST);
  EXPECT_EQ(things.choices[1].chosen, FINEST);
  things.choose({9.0, 1.0}, 3.0, 0.1, 1.2);  // both have changed just now
  EXPECT_EQ(things.choices[1].chosen, FINEST);
}

TEST(TierHysteresis, AFinerTierIsKeptUntilTheCoarserOneIsWellWithin) {
  Things things;
  EXPECT_EQ(things.choose({1.0}, 9.0, 3.9, 0.0)[0].chosen, 2);
  EXPECT_EQ(things.choose({1.0}, 9.0, 4.1, 5.0)[0].chosen, 2);
  EXPECT_EQ(things.choose({1.0}, 9.0, 6.0, 9.0)[0].chosen, 1);
}

TEST(TierHysteresis, ForgetsWhoIsNotThere) {
  Things things;
  things.choose({1.0, 1.0, 1.0}, 99.0, 1.0, 0.0);
  things.choose({1.0, 0.0, 1.0}, 99.0, 1.0, 0.1);
  things.choose({1.0, 1.0, 1.0}, 99.0, 1.0, 0.2);
  EXPECT_EQ(things.choices[0].held, FINEST);
  EXPECT_EQ(things.choices[1].held, 0);
  EXPECT_EQ(things.choices[2].held, FINEST);
}

// The outcome is that of a fresh start then.
TEST(TierHysteresis, ForgetsAllWhenTimeGoesBack) {
  Things things;
  things.choose({1.0, 1.0}, 3.0, 0.1, 10.0);
  things.choose({1.0, 1.0}, 3.0, 0.1, 5.0);
  for (const TierChoice& choice : things.choices) {
    EXPECT_EQ(choice.held, 0);
    EXPECT_FALSE(choice.resting);
  }
  things.choose({1.0, 1.0}, 3.0, 0.1, 5.1);
  EXPECT_TRUE(things.choices[0].resting);
}

}  // namespace
}  // namespace vegetation_sim

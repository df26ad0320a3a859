// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/state/level_map.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

constexpr double TRANSITION = 2.0;  // [s]

std::uint64_t hashOf(const LevelMap& levels, Nanoseconds stamp) {
  Hash hash;
  levels.addTo(hash, stamp, TRANSITION);
  return hash.value();
}

// S1-22, S1-23: all trees that are not held change with the base, without taking memory.
TEST(LevelMap, BaseChangesContinuously) {
  LevelMap levels;
  levels.reset(LevelState::settled(2));
  levels.changeBase(0, seconds(10.0), TRANSITION);
  EXPECT_TRUE(levels.held().empty());
  const LevelState tree = levels.of(123456);
  EXPECT_EQ(tree.level, 0);
  EXPECT_EQ(blendAt(tree, seconds(10.0), TRANSITION)[1], 1.0);
  EXPECT_DOUBLE_EQ(blendAt(tree, seconds(11.0), TRANSITION)[1], 0.5);
  EXPECT_EQ(blendAt(tree, seconds(12.0), TRANSITION)[1], 0.0);
}

// S1-24: the base may change again during a transition, as a tree may.
TEST(LevelMap, BaseTurnsRound) {
  LevelMap levels;
  levels.reset(LevelState::settled(2));
  levels.changeBase(0, seconds(10.0), TRANSITION);
  levels.changeBase(2, seconds(11.0), TRANSITION);
  EXPECT_DOUBLE_EQ(blendAt(levels.of(1), seconds(11.0), TRANSITION)[0], 0.5);
  EXPECT_EQ(blendAt(levels.of(1), seconds(12.0), TRANSITION)[0], 1.0);
}

TEST(LevelMap, HeldTreesKeepTheirLevelsWhenTheBaseChanges) {
  LevelMap levels;
  levels.set(7, LevelState::settled(3));
  levels.changeBase(2, seconds(10.0), TRANSITION);
  EXPECT_EQ(levels.of(7).level, 3);
  EXPECT_EQ(levels.of(8).level, 2);
}

TEST(LevelMap, CountsTheTreesOfEachLevel) {
  LevelMap levels;
  levels.reset(LevelState::settled(0));
  levels.set(7, LevelState::settled(3));
  levels.set(8, LevelState::settled(3));
  levels.set(9, LevelState::settled(MODAL_LEVEL));
  const auto counts = levels.counts(100);
  EXPECT_EQ(counts.front(), 97u);
  EXPECT_EQ(counts[3], 2u);
  EXPECT_EQ(counts.back(), 1u);
}

// A tree at the base's level is removed only when the base has settled too.
TEST(LevelMap, ForgetsWhatIsLikeTheBase) {
  LevelMap levels;
  levels.reset(LevelState::settled(2));
  levels.changeBase(0, seconds(10.0), TRANSITION);
  levels.set(7, LevelState::settled(0));
  levels.prune(seconds(11.0), TRANSITION);
  EXPECT_EQ(levels.of(7).blend[0], 0.f);
  EXPECT_EQ(levels.held().size(), 1u);
  levels.prune(seconds(12.0), TRANSITION);
  EXPECT_TRUE(levels.held().empty());
  EXPECT_EQ(levels.base().blend, LevelState::settled(0).blend);
}

TEST(LevelMap, HashIsTheSameWhetherOrNotPruned) {
  LevelMap levels;
  levels.reset(LevelState::settled(1));
  for (std::uint32_t tree = 0; tree < 3; ++tree) {
    LevelState state = LevelState::settled(1);
    setLevel(state, static_cast<int>(tree), seconds(5.0), TRANSITION);
    levels.set(tree, state);
  }
  levels.changeBase(2, seconds(6.0), TRANSITION);
  for (const double now : {6.0, 6.9, 7.5, 8.0, 9.0}) {
    LevelMap pruned = levels;
    pruned.prune(seconds(now), TRANSITION);
    EXPECT_EQ(hashOf(pruned, seconds(now)), hashOf(levels, seconds(now))) << now;
  }
  EXPECT_NE(hashOf(levels, seconds(6.5)), hashOf(levels, seconds(7.0)));
}

}  // namespace
}  // namespace vegetation_sim::forest

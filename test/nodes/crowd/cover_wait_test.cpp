// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/cover_wait.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr int RATE = 30;  // ticks per second
constexpr std::int64_t FIRST = 1000;
const TickGrid GRID(RATE);

Nanoseconds at(std::int64_t tick) {
  return GRID.timeOf(tick);
}

/// Of a meadow with two maps a second: at ticks 1005, 1020, 1035, and at 1000 where it begins too.
CoverWait begun() {
  CoverWait out(2.0, RATE);
  out.jumpBack();
  out.begin(at(FIRST));
  return out;
}

TEST(CoverWait, TheFirstTickAndThatOfEachPeriodHaveAMap) {
  CoverWait wait = begun();
  EXPECT_TRUE(wait.hasMapOf(at(FIRST - 1)));  // before the meadow
  EXPECT_FALSE(wait.hasMapOf(at(FIRST)));
  EXPECT_TRUE(wait.hear(at(FIRST), at(FIRST)));
  EXPECT_TRUE(wait.hasMapOf(at(1004)));
  EXPECT_FALSE(wait.hasMapOf(at(1005)));
  EXPECT_TRUE(wait.hear(at(1005), at(1006)));
  EXPECT_TRUE(wait.hasMapOf(at(1019)));
  EXPECT_FALSE(wait.hasMapOf(at(1020)));
  EXPECT_TRUE(wait.hear(at(1035), at(1021)));  // of a meadow that is ahead
  EXPECT_TRUE(wait.hasMapOf(at(1020)));
}

TEST(CoverWait, AMeadowThatRunsAlreadyIsAwaitedInVainOnce) {
  CoverWait wait(2.0, RATE);
  wait.begin(at(1007));
  EXPECT_FALSE(wait.hasMapOf(at(1007)));
  EXPECT_TRUE(wait.endWait(false));
  EXPECT_TRUE(wait.hasMapOf(at(1020)));
  EXPECT_TRUE(wait.hear(at(1020), at(1021)));
  EXPECT_TRUE(wait.hasMapOf(at(1034)));
  EXPECT_FALSE(wait.hasMapOf(at(1035)));
}

TEST(CoverWait, AMeadowThatHangsIsAwaitedAgainOnceItSends) {
  CoverWait wait = begun();
  EXPECT_TRUE(wait.endWait(wait.hasMapOf(at(1020))));
  EXPECT_TRUE(wait.hasMapOf(at(1020)));
  EXPECT_FALSE(wait.endWait(true));
  EXPECT_TRUE(wait.hear(at(1000), at(1000)));
  EXPECT_FALSE(wait.hasMapOf(at(1035)));
}

TEST(CoverWait, MapsFromBeforeAJumpBackAreVoid) {
  CoverWait wait = begun();
  wait.hear(at(FIRST), at(FIRST));
  wait.hear(at(1020), at(1021));
  wait.jumpBack();
  wait.begin(at(FIRST));
  EXPECT_FALSE(wait.hear(at(1035), at(FIRST)));
  EXPECT_FALSE(wait.hasMapOf(at(FIRST)));
  EXPECT_TRUE(wait.hear(at(FIRST), at(FIRST)));
  EXPECT_TRUE(wait.hasMapOf(at(FIRST)));
}

TEST(CoverWait, MapsFromBeforeALoadAreVoid) {
  CoverWait wait = begun();
  wait.hear(at(FIRST), at(FIRST));
  wait.onLoaded(at(1006));
  EXPECT_TRUE(wait.hasMapOf(at(1019)));  // that of 1005 is in the state
  EXPECT_FALSE(wait.hear(at(1006), at(1007)));
  EXPECT_FALSE(wait.hasMapOf(at(1020)));
  EXPECT_TRUE(wait.hear(at(1), at(1007)));  // a map that does not change
  EXPECT_TRUE(wait.hear(at(1020), at(1021)));
  EXPECT_TRUE(wait.hasMapOf(at(1020)));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

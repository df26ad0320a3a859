// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Trodden grass as time goes by: recovery, memory, bad input, saved state.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "scenes/grass/tread_fixture.h"

namespace vegetation_sim::grass {
namespace {

class TreadTime : public Treading {};

// ---- recovery --------------------------------------------------------------------------------

// S2-28: full at once, gone after the interval, by smooth steps between; a function of the stamp.
TEST_F(TreadTime, RecoversOverItsInterval) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  const Point p{7.0, 10.0};
  EXPECT_FLOAT_EQ(map_.at(p, START).tilt, 1.5f);
  EXPECT_NEAR(map_.at(p, after(15.0)).tilt, 1.5 * (1.0 - 0.15625), 1e-6);
  EXPECT_NEAR(map_.at(p, after(30.0)).tilt, 0.75, 1e-6);
  EXPECT_EQ(map_.at(p, after(60.0)).tilt, 0.f);
  EXPECT_EQ(map_.at(p, after(1e6)).tilt, 0.f);
}

// S2-28: queries change nothing, and nothing moves while the clock stands.
TEST_F(TreadTime, RecoveryDoesNotDependOnQueries) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  TreadMap watched = map_;
  CrushPatch patch;
  for (int k = 0; k < 240; ++k) watched.patch(3, 5, after(k / 24.0), patch);
  for (int k = 0; k < 100; ++k) watched.at({7.0, 10.0}, after(10.0));
  EXPECT_EQ(watched.state().hash(), map_.state().hash());
  EXPECT_EQ(watched.at({7.0, 10.0}, after(10.0)).tilt, map_.at({7.0, 10.0}, after(10.0)).tilt);
}

// S2-28: trodden again it starts anew from where it is.
TEST_F(TreadTime, RecoveryStartsAgainWhenTroddenAgain) {
  const Point p{7.0, 10.0};
  TreadLaw light;
  light.load = 0.1;
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  walk(map_, light, {5.0, 10.0}, {9.0, 10.0}, 50, after(30.0), 2);
  EXPECT_NEAR(map_.at(p, after(30.0)).tilt, 0.75, 1e-6);  // 0.44 rad alone
  EXPECT_NEAR(map_.at(p, after(60.0)).tilt, 0.375, 1e-6);
  EXPECT_EQ(map_.at(p, after(90.0)).tilt, 0.f);
}

// S2-21: each source by its own law.
TEST_F(TreadTime, RecoversAtOnceOrNeverByItsLaw) {
  TreadLaw at_once;
  at_once.recovery = 0.0;
  walk(map_, at_once, {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  EXPECT_EQ(map_.at({7.0, 10.0}, START).tilt, 0.f);
  walk(map_, permanent(), {5.0, 12.0}, {9.0, 12.0}, 50, START, 2);
  EXPECT_FLOAT_EQ(map_.at({7.0, 12.0}, after(3e7)).tilt, 1.5f);
}

// A node that has risen takes the direction of the next track.
TEST_F(TreadTime, TakesANewDirectionAfterRecovery) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  walk(map_, TreadLaw(), {7.0, 8.0}, {7.0, 12.0}, 50, after(100.0), 2);
  EXPECT_NEAR(map_.at({7.0, 10.0}, after(100.0)).y, 1.0, 1e-6);
}

// S2-28: a query at a stamp before the stroke finds no trace of it.
TEST_F(TreadTime, IsUntroddenBeforeTheStampOfTheStroke) {
  walk(map_, TreadLaw(), {5.0, 12.0}, {9.0, 12.0}, 50, after(20.0));
  EXPECT_EQ(map_.at({7.0, 12.0}, after(10.0)).tilt, 0.f);
}

// ---- memory ----------------------------------------------------------------------------------

// S2-W1: fine nodes exist only where a source trod, and are freed when the grass has recovered.
TEST_F(TreadTime, HoldsMemoryOnlyWhereGrassIsDown) {
  EXPECT_EQ(map_.bytes(), 0u);
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  map_.lift(1);
  const std::size_t bytes = map_.bytes();
  EXPECT_GT(bytes, 10000u);
  EXPECT_LT(bytes, 200000u);  // all of the map would be 4 MB
  map_.prune(after(59.0));
  EXPECT_EQ(map_.bytes(), bytes);
  map_.prune(after(60.0));
  EXPECT_EQ(map_.bytes(), 0u);
}

// S2-W1, S2-21: a print of 5 cm is resolved while the tiles are 2 m.
TEST_F(TreadTime, ResolvesASmallFoot) {
  TreadLaw foot = permanent();
  foot.radius = 0.05;
  foot.reach = 0.08;
  foot.softness = 0.03;
  map_.tread(1, foot, {7.0, 10.0}, START);
  EXPECT_GT(map_.at({7.05, 10.0}, START).tilt, 1.4f);
  EXPECT_EQ(map_.at({7.1, 10.0}, START).tilt, 0.f);
}

// The doses of a wide source take more than the ground that it presses.
TEST_F(TreadTime, TheMemoryCapIncludesSources) {
  TreadMap small = makeMap(0.05, 4e6);
  TreadLaw wide = permanent();
  wide.reach = 10.0;
  for (std::uint32_t source = 1; source <= 100; ++source) {
    small.tread(source, wide, {10.0, 10.0}, START);
    ASSERT_LE(small.bytes(), 4000000u) << source;
  }
  EXPECT_GT(small.state().counts.no_memory, 90u);
  for (std::uint32_t source = 1; source <= 100; ++source) small.lift(source);
  const std::uint64_t left_out = small.state().counts.no_memory;
  small.tread(1, permanent(), {10.0, 10.0}, START);
  EXPECT_EQ(small.state().counts.no_memory, left_out);
}

TEST_F(TreadTime, CountsWhatTheMemoryCapLeavesOut) {
  TreadMap small = makeMap(0.05, 1e5);
  walk(small, permanent(), {1.0, 10.0}, {19.0, 10.0}, 400, START);
  small.lift(1);
  EXPECT_LE(small.bytes(), 100000u);
  EXPECT_GT(small.state().counts.no_memory, 0u);
  EXPECT_GT(small.at({1.5, 10.0}, START).tilt, 1.f);
  EXPECT_EQ(small.at({18.0, 10.0}, START).tilt, 0.f);
}

// ---- bad input -------------------------------------------------------------------------------

TEST_F(TreadTime, CountsWhatIsNoStroke) {
  map_.tread(1, permanent(), {7.0, 10.0}, after(1.0));
  const std::uint64_t blocks = map_.state().blocks.size();
  EXPECT_EQ(map_.tread(1, permanent(), {std::nan(""), 10.0}, after(1.0)), 0);
  EXPECT_EQ(map_.tread(1, permanent(), {7.0, INFINITY}, after(1.0)), 0);
  EXPECT_EQ(map_.tread(1, permanent(), {7.1, 10.0}, after(0.5)), 0);
  EXPECT_EQ(map_.state().counts.invalid, 3u);
  EXPECT_EQ(map_.state().blocks.size(), blocks);
  EXPECT_EQ(map_.tread(2, permanent(), {-50.0, 10.0}, START), 0);
  EXPECT_EQ(map_.tread(3, permanent(), {1e300, -1e300}, START), 0);
  EXPECT_EQ(map_.state().counts.outside, 2u);
}

// A source that jumps leaves no furrow of 10 m, only its print where it lands.
TEST_F(TreadTime, AJumpLeavesNoTrack) {
  map_.tread(1, permanent(), {4.0, 10.0}, START);
  map_.tread(1, permanent(), {14.0, 10.0}, after(10.0));
  EXPECT_EQ(map_.at({9.0, 10.0}, after(10.0)).tilt, 0.f);
  EXPECT_GT(map_.at({14.0, 10.0}, after(10.0)).tilt, 1.f);
  map_.tread(1, permanent(), {17.0, 10.0}, after(10.01));  // 3 m in 10 ms
  EXPECT_EQ(map_.at({15.5, 10.0}, after(10.01)).tilt, 0.f);
  EXPECT_EQ(map_.state().counts.jumps, 2u);
}

TEST_F(TreadTime, IsClippedAtTheBorderOfTheMap) {
  walk(map_, permanent(), {19.0, 10.0}, {21.0, 10.0}, 20, START);
  EXPECT_GT(map_.at({20.0, 10.0}, START).tilt, 1.f);
  EXPECT_EQ(map_.at({0.0, 10.0}, START).tilt, 0.f);  // no wrap
  EXPECT_EQ(map_.at({20.1, 10.0}, START).tilt, 0.f);
}

TEST_F(TreadTime, RejectsBadSettingsWithTheirNames) {
  TreadSettings settings;
  settings.spacing = 0.0;
  settings.memory_cap = -1.0;
  EXPECT_EQ(errorOf([&] { TreadMap map(mapLaw(), settings); }),
            "treading: spacing = 0 m is outside 0.01 to 10 m\n"
            "treading: memory_cap = -1 bytes is outside 100000 to 1e+11 bytes");
  MapLaw wide = mapLaw();
  wide.resolution = 100.0;
  EXPECT_EQ(errorOf([&] { TreadMap map(wide, TreadSettings()); }),
            "treading: spacing = 0.050000 m makes 2000 cells along a tile of 100.000000 m, allowed "
            "are 512");
}

// ---- state -----------------------------------------------------------------------------------

// One structure is all that has memory: restored in the middle of a walk, it goes on to the bit.
TEST_F(TreadTime, GoesOnFromARestoredState) {
  const auto step = [](TreadMap& map, int k) {
    for (std::uint32_t source = 1; source <= 3; ++source)
      map.tread(source, TreadLaw(), {5.0 + 0.02 * k, 9.0 + source + 0.3 * std::sin(0.1 * k)},
                after(0.05 * k));
  };
  for (int k = 0; k < 100; ++k) step(map_, k);
  TreadMap copy = makeMap();
  copy.restore(map_.state());
  EXPECT_EQ(copy.state().hash(), map_.state().hash());
  for (int k = 100; k < 200; ++k) {
    step(map_, k);
    step(copy, k);
    ASSERT_EQ(copy.state().hash(), map_.state().hash()) << k;
  }
  step(map_, 200);
  EXPECT_NE(copy.state().hash(), map_.state().hash());
}

// S2-27, S2-17: patches for drawing hold what at() says; an untrodden tile costs nothing.
TEST_F(TreadTime, PatchHoldsTheNodesOfItsTile) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.3}, 50, START);
  CrushPatch patch;
  map_.patch(3, 5, after(7.0), patch);
  ASSERT_EQ(patch.cells, 40);
  for (int row = 0; row <= 40; ++row)
    for (int column = 0; column <= 40; ++column) {
      const TreadNode node = map_.at({6.0 + 0.05 * column, 10.0 + 0.05 * row}, after(7.0));
      const auto k = static_cast<std::size_t>(row * 41 + column);
      ASSERT_EQ(patch.tilt[k], node.tilt);
      ASSERT_EQ(patch.tx[k], node.tilt * node.x);
      ASSERT_EQ(patch.ty[k], node.tilt * node.y);
    }
  map_.patch(8, 8, after(7.0), patch);
  EXPECT_EQ(patch.cells, 0);
  map_.patch(3, 5, after(60.0), patch);
  EXPECT_EQ(patch.cells, 0);
}

}  // namespace
}  // namespace vegetation_sim::grass

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/error_text.h"
#include "vegetation_sim/common/math.h"
#include "vegetation_sim/common/random.h"

namespace vegetation_sim::grass {
namespace {

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;

Nanoseconds after(double seconds) {
  return START + fromSeconds(seconds);
}

TreadLaw permanent() {
  TreadLaw law;
  law.recovery = PERMANENT_RECOVERY;
  return law;
}

// A map of 20 m with nodes 5 cm apart.
class Treading : public testing::Test {
 protected:
  static MapLaw mapLaw() {
    MapLaw law;
    law.columns = law.rows = 11;
    return law;
  }
  static TreadMap makeMap(double spacing = 0.05, double cap = 128e6) {
    TreadSettings settings;
    settings.spacing = spacing;
    settings.memory_cap = cap;
    return TreadMap(mapLaw(), settings);
  }

  // A walk from a to b in equal steps, all at one stamp.
  static void walk(TreadMap& map, const TreadLaw& law, const Point& a, const Point& b, int steps,
                   Nanoseconds stamp, std::uint32_t source = 1) {
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      map.tread(source, law, {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, stamp);
    }
  }

  TreadMap map_{makeMap()};
};

struct Difference {
  double tilt{0.0}, direction{0.0};
  int nodes{0};
};

Difference differenceOf(const TreadMap& a, const TreadMap& b, Nanoseconds stamp) {
  Difference out;
  for (double x = 0.0; x <= 20.0; x += 0.05)
    for (double y = 8.0; y <= 12.0; y += 0.05) {
      const TreadNode p = a.at({x, y}, stamp), q = b.at({x, y}, stamp);
      out.tilt = std::max(out.tilt, std::fabs(double{p.tilt} - q.tilt));
      out.direction =
          std::max({out.direction, std::fabs(double{p.x} - q.x), std::fabs(double{p.y} - q.y)});
      if (p.tilt > 0.f) ++out.nodes;
    }
  return out;
}

// S2-22, S2-23: the same 4 m in 1, 16, 1 024 and 16 384 steps leave the same grass, on an axis of
// the grid and across it.
TEST_F(Treading, DoesNotDependOnTheNumberOfSteps) {
  for (const Point end : {Point{9.0, 10.0}, Point{8.2, 11.3}}) {
    TreadMap once = makeMap();
    walk(once, permanent(), {5.0, 10.0}, end, 1, START);
    for (const int steps : {16, 1024, 16384}) {
      TreadMap often = makeMap();
      walk(often, permanent(), {5.0, 10.0}, end, steps, START);
      const Difference difference = differenceOf(once, often, after(1.0));
      EXPECT_GT(difference.nodes, 1000);
      EXPECT_LT(difference.tilt, 1e-5) << steps;
      EXPECT_LT(difference.direction, 1e-5) << steps;
    }
  }
}

// The same with a load that saturates nowhere, so that doses themselves are compared, and with a
// second source that treads the same ground in turn.
TEST_F(Treading, KeepsTheDosesOfSourcesApart) {
  TreadLaw light = permanent();
  light.load = 0.2;
  TreadMap once = makeMap(), turns = makeMap();
  walk(once, light, {5.0, 10.0}, {9.0, 10.0}, 1, START, 1);
  walk(once, light, {5.0, 10.1}, {9.0, 10.1}, 1, START, 2);
  for (int k = 0; k <= 1000; ++k) {
    turns.tread(1, light, {5.0 + 0.004 * k, 10.0}, START);
    turns.tread(2, light, {5.0 + 0.004 * k, 10.1}, START);
  }
  // Directions belong to whoever comes first, so only tilts are equal.
  EXPECT_LT(differenceOf(once, turns, after(1.0)).tilt, 1e-5);
}

// S2-23: no bulges: across a straight track of many steps every section is the same.
TEST_F(Treading, LeavesNoBulgesAlongAStraightTrack) {
  walk(map_, permanent(), {4.0, 10.0}, {9.0, 10.0}, 7, START);
  for (double y = 9.6; y <= 10.4; y += 0.05)
    for (double x = 5.0; x <= 8.0; x += 0.05)
      EXPECT_NEAR(map_.at({x, y}, START).tilt, map_.at({6.0, y}, START).tilt, 1e-5);
}

// S2-24: nodes touched are those within reach: brute force over all nodes.
TEST_F(Treading, TouchesTheNodesWithinReachAndNoOthers) {
  const TreadLaw law = permanent();
  for (int i = 0; i < 100; ++i) {
    const Random random(static_cast<std::uint64_t>(i));
    const Point a{random.uniform(0, 2, 18), random.uniform(1, 2, 18)};
    const Point b{a.x + random.uniform(2, -2, 2), a.y + random.uniform(3, -2, 2)};
    TreadMap map = makeMap(0.25);
    map.tread(1, law, a, START);
    const int touched = map.tread(1, law, b, START);
    const CompactField field(a, b, law.reach, law.softness);
    int expected = 0;
    for (int row = 0; row <= 80; ++row)
      for (int column = 0; column <= 80; ++column)
        if (field.placeOf({0.25 * column, 0.25 * row}).square_distance < law.reach * law.reach)
          ++expected;
    EXPECT_EQ(touched, expected) << i;
  }
}

// S2-24: the paper visits neighbours from the nearest node on until the field is gone. That finds
// all of them where the reach is at least the spacing, and misses some below.
int missedByFlood(double reach, int strokes) {
  constexpr double H = 0.25;
  int missed = 0;
  for (int i = 0; i < strokes; ++i) {
    const Random random(static_cast<std::uint64_t>(i));
    const Point a{random.uniform(0, 4, 6), random.uniform(1, 4, 6)};
    const Point b{a.x + random.uniform(2, -1, 1), a.y + random.uniform(3, -1, 1)};
    const CompactField field(a, b, reach, 0.1);
    const auto inside = [&](int column, int row) {
      return field.placeOf({H * column, H * row}).square_distance < reach * reach;
    };
    std::set<std::pair<int, int>> seen;
    std::vector<std::pair<int, int>> open{
        {static_cast<int>(std::lround(a.x / H)), static_cast<int>(std::lround(a.y / H))}};
    while (!open.empty()) {
      const auto [column, row] = open.back();
      open.pop_back();
      if (!inside(column, row) || !seen.insert({column, row}).second) continue;
      for (const int d : {-1, 1}) {
        open.push_back({column + d, row});
        open.push_back({column, row + d});
      }
    }
    for (int row = 0; row <= 40; ++row)
      for (int column = 0; column <= 40; ++column)
        if (inside(column, row) && !seen.count({column, row})) ++missed;
  }
  return missed;
}

TEST_F(Treading, FloodFillEqualsBruteForceWhereTheReachIsTheSpacingOrMore) {
  EXPECT_EQ(missedByFlood(0.25, 300), 0);
  EXPECT_EQ(missedByFlood(0.35, 300), 0);
  EXPECT_EQ(missedByFlood(0.60, 300), 0);
  EXPECT_GT(missedByFlood(0.15, 300), 0);
}

// S2-25: left of the track the grass lies to the left and forward.
TEST_F(Treading, LaysTheGrassAsideAndForward) {
  walk(map_, permanent(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  const TreadNode left = map_.at({7.0, 10.1}, START), right = map_.at({7.0, 9.9}, START);
  const TreadNode on = map_.at({7.0, 10.0}, START);
  const auto half = static_cast<float>(std::sqrt(0.5));
  EXPECT_NEAR(left.x, half, 1e-6);
  EXPECT_NEAR(left.y, half, 1e-6);
  EXPECT_NEAR(right.y, -half, 1e-6);
  EXPECT_NEAR(on.x, 1.0, 1e-6);
  EXPECT_NEAR(on.y, 0.0, 1e-6);
}

// S2-26: within the radius of a straight track the grass is crushed fully, to 4 degrees from flat.
TEST_F(Treading, CrushesFullyWithinTheRadius) {
  walk(map_, permanent(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  for (const double y : {9.9, 10.0, 10.1})
    EXPECT_FLOAT_EQ(map_.at({7.0, y}, START).tilt, static_cast<float>(BEND_LIMIT));
  const float beside = map_.at({7.0, 10.25}, START).tilt;
  EXPECT_GT(beside, 0.05f);
  EXPECT_LT(beside, 1.0f);
  EXPECT_EQ(map_.at({7.0, 10.4}, START).tilt, 0.f);
}

// S2-27, E15: a second pass at a right angle keeps the azimuth bit by bit; the larger tilt counts.
TEST_F(Treading, KeepsTheDirectionOfGrassThatIsTroddenAgain) {
  TreadLaw law;
  law.load = 0.3;
  walk(map_, law, {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  TreadMap before = map_;
  TreadLaw heavy;
  walk(map_, heavy, {7.0, 8.0}, {7.0, 12.0}, 50, after(1.0), 2);
  TreadMap alone = makeMap();
  walk(alone, heavy, {7.0, 8.0}, {7.0, 12.0}, 50, after(1.0), 2);
  int compared = 0;
  for (double x = 6.5; x <= 7.5; x += 0.05)
    for (double y = 9.6; y <= 10.4; y += 0.05) {
      const Point p{x, y};
      const TreadNode first = before.at(p, after(1.0)), both = map_.at(p, after(1.0));
      const TreadNode second = alone.at(p, after(1.0));
      if (first.tilt > CRUNCHED) {
        EXPECT_EQ(both.x, first.x);
        EXPECT_EQ(both.y, first.y);
        ++compared;
      }
      EXPECT_EQ(both.tilt, std::max(first.tilt, second.tilt));
    }
  EXPECT_GT(compared, 100);
}

// S2-27: doses add up within a pass and do not between passes.
TEST_F(Treading, AddsDosesWithinAPassOnly) {
  TreadLaw light = permanent();
  light.load = 0.2;
  const Point beside{7.0, 10.2};
  // To and fro without leaving: one pass.
  TreadMap staying = makeMap();
  for (int k = 0; k <= 6; ++k) staying.tread(1, light, {k % 2 ? 7.05 : 6.95, 10.0}, START);
  TreadMap once = makeMap();
  walk(once, light, {6.95, 10.0}, {7.05, 10.0}, 1, START);
  EXPECT_NEAR(staying.at(beside, START).tilt, 6.f * once.at(beside, START).tilt, 1e-6);
  // Away and back: a new pass each time.
  TreadMap single = makeMap(), several = makeMap();
  walk(single, light, {5.0, 10.0}, {9.0, 10.0}, 40, START);
  for (int k = 0; k < 5; ++k) {
    walk(several, light, {5.0, 10.0}, {9.0, 10.0}, 40, START);
    several.lift(1);
  }
  EXPECT_NEAR(several.at(beside, START).tilt, single.at(beside, START).tilt, 1e-6);
}

// S2-22, E5: a standing foot leaves a print though its segment has no length.
TEST_F(Treading, AStandingFootLeavesAPrint) {
  EXPECT_GT(map_.tread(1, permanent(), {7.0, 10.0}, START), 0);
  EXPECT_FLOAT_EQ(map_.at({7.0, 10.0}, START).tilt, static_cast<float>(BEND_LIMIT));
  EXPECT_FLOAT_EQ(map_.at({7.1, 10.0}, START).tilt, static_cast<float>(BEND_LIMIT));
  EXPECT_EQ(map_.at({7.2, 10.0}, START).tilt, 0.f);
  EXPECT_NEAR(map_.at({7.1, 10.0}, START).x, 1.0, 1e-6);  // outward
  EXPECT_NEAR(map_.at({7.0, 9.9}, START).y, -1.0, 1e-6);
  const std::uint64_t print = map_.state().hash();
  EXPECT_NE(print, makeMap().state().hash());
}

// ---- recovery --------------------------------------------------------------------------------

// S2-28: full at once, gone after the interval, by smooth steps between; a function of the stamp.
TEST_F(Treading, RecoversOverItsInterval) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  const Point p{7.0, 10.0};
  EXPECT_FLOAT_EQ(map_.at(p, START).tilt, 1.5f);
  EXPECT_NEAR(map_.at(p, after(15.0)).tilt, 1.5 * (1.0 - 0.15625), 1e-6);
  EXPECT_NEAR(map_.at(p, after(30.0)).tilt, 0.75, 1e-6);
  EXPECT_EQ(map_.at(p, after(60.0)).tilt, 0.f);
  EXPECT_EQ(map_.at(p, after(1e6)).tilt, 0.f);
}

// S2-28: who asks, and how often, changes nothing; while the clock stands nothing moves.
TEST_F(Treading, RecoveryDoesNotDependOnWhoAsks) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START);
  TreadMap watched = map_;
  CrushPatch patch;
  for (int k = 0; k < 240; ++k) watched.patch(3, 5, after(k / 24.0), patch);
  for (int k = 0; k < 100; ++k) watched.at({7.0, 10.0}, after(10.0));
  EXPECT_EQ(watched.state().hash(), map_.state().hash());
  EXPECT_EQ(watched.at({7.0, 10.0}, after(10.0)).tilt, map_.at({7.0, 10.0}, after(10.0)).tilt);
}

// S2-28: trodden again it starts anew from where it is.
TEST_F(Treading, RecoveryStartsAgainWhenTroddenAgain) {
  const Point p{7.0, 10.0};
  TreadLaw light;
  light.load = 0.1;
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  walk(map_, light, {5.0, 10.0}, {9.0, 10.0}, 50, after(30.0), 2);
  EXPECT_NEAR(map_.at(p, after(30.0)).tilt, 0.75, 1e-6);  // 0.44 rad alone
  EXPECT_NEAR(map_.at(p, after(60.0)).tilt, 0.375, 1e-6);
  EXPECT_EQ(map_.at(p, after(90.0)).tilt, 0.f);
}

TEST_F(Treading, RecoversAtOnceOrNeverIfToldSo) {
  TreadLaw at_once;
  at_once.recovery = 0.0;
  walk(map_, at_once, {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  EXPECT_EQ(map_.at({7.0, 10.0}, START).tilt, 0.f);
  walk(map_, permanent(), {5.0, 12.0}, {9.0, 12.0}, 50, START, 2);
  EXPECT_FLOAT_EQ(map_.at({7.0, 12.0}, after(3e7)).tilt, 1.5f);
}

// A node that has risen takes the direction of the next track.
TEST_F(Treading, TakesANewDirectionAfterRecovery) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  walk(map_, TreadLaw(), {7.0, 8.0}, {7.0, 12.0}, 50, after(100.0), 2);
  EXPECT_NEAR(map_.at({7.0, 10.0}, after(100.0)).y, 1.0, 1e-6);
}

// S2-28: after time went back the strokes of the future are forgotten.
TEST_F(Treading, ForgetsTheFutureWhenTimeGoesBack) {
  walk(map_, TreadLaw(), {5.0, 10.0}, {9.0, 10.0}, 50, START, 1);
  map_.lift(1);
  const std::uint64_t past = map_.state().hash();
  const TreadCounts counts = map_.state().counts;
  walk(map_, TreadLaw(), {5.0, 12.0}, {9.0, 12.0}, 50, after(20.0), 2);
  EXPECT_EQ(map_.at({7.0, 12.0}, after(10.0)).tilt, 0.f);  // before its stamp
  map_.rewind(after(10.0));
  EXPECT_EQ(map_.at({7.0, 12.0}, after(20.0)).tilt, 0.f);
  EXPECT_GT(map_.at({7.0, 10.0}, after(10.0)).tilt, 1.f);
  TreadState state = map_.state();
  state.counts = counts;  // those go on
  EXPECT_EQ(state.hash(), past);
}

// ---- memory ----------------------------------------------------------------------------------

// S2-W1: fine nodes exist only where somebody trod, and go when the grass has risen.
TEST_F(Treading, HoldsMemoryOnlyWhereGrassIsDown) {
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

// S2-W1: a print of 5 cm is resolved while the tiles are 2 m.
TEST_F(Treading, ResolvesASmallFoot) {
  TreadLaw foot = permanent();
  foot.radius = 0.05;
  foot.reach = 0.08;
  foot.softness = 0.03;
  map_.tread(1, foot, {7.0, 10.0}, START);
  EXPECT_GT(map_.at({7.05, 10.0}, START).tilt, 1.4f);
  EXPECT_EQ(map_.at({7.1, 10.0}, START).tilt, 0.f);
}

TEST_F(Treading, CountsWhatTheMemoryCapLeavesOut) {
  TreadMap small = makeMap(0.05, 1e5);
  walk(small, permanent(), {1.0, 10.0}, {19.0, 10.0}, 400, START);
  small.lift(1);
  EXPECT_LE(small.bytes(), 100000u);
  EXPECT_GT(small.state().counts.no_memory, 0u);
  EXPECT_GT(small.at({1.5, 10.0}, START).tilt, 1.f);
  EXPECT_EQ(small.at({18.0, 10.0}, START).tilt, 0.f);
}

// ---- bad input -------------------------------------------------------------------------------

TEST_F(Treading, CountsWhatIsNoStroke) {
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
TEST_F(Treading, AJumpLeavesNoTrack) {
  map_.tread(1, permanent(), {4.0, 10.0}, START);
  map_.tread(1, permanent(), {14.0, 10.0}, after(10.0));
  EXPECT_EQ(map_.at({9.0, 10.0}, after(10.0)).tilt, 0.f);
  EXPECT_GT(map_.at({14.0, 10.0}, after(10.0)).tilt, 1.f);
  map_.tread(1, permanent(), {17.0, 10.0}, after(10.01));  // 3 m in 10 ms
  EXPECT_EQ(map_.at({15.5, 10.0}, after(10.01)).tilt, 0.f);
  EXPECT_EQ(map_.state().counts.jumps, 2u);
}

TEST_F(Treading, IsClippedAtTheBorderOfTheMap) {
  walk(map_, permanent(), {19.0, 10.0}, {21.0, 10.0}, 20, START);
  EXPECT_GT(map_.at({20.0, 10.0}, START).tilt, 1.f);
  EXPECT_EQ(map_.at({0.0, 10.0}, START).tilt, 0.f);  // no wrap
  EXPECT_EQ(map_.at({20.1, 10.0}, START).tilt, 0.f);
}

TEST_F(Treading, RefusesBadSettingsByName) {
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
TEST_F(Treading, GoesOnFromARestoredState) {
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
TEST_F(Treading, PatchHoldsTheNodesOfItsTile) {
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

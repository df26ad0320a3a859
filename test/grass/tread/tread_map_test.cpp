// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "scenes/grass/tread_fixture.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

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
  // The first source sets the direction, so only tilts are equal.
  EXPECT_LT(differenceOf(once, turns, after(1.0)).tilt, 1e-5);
}

// Vectors of any width and none at all, short steps and long, off the map's edge too.
TEST_F(Treading, GivesTheSameBitsOnAllInstructionSets) {
  ASSERT_GE(instructionSets().size(), 2u);
  std::set<std::uint64_t> hashes;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    TreadMap map = makeMap();
    TreadLaw law;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Random random(i);
      law.load = random.uniform(0, 0.05, 2.0);
      Point p{random.uniform(1, 0.0, 20.0), random.uniform(2, 0.0, 20.0)};
      for (std::uint64_t k = 0; k < 6; ++k) {
        map.tread(static_cast<std::uint32_t>(i), law, p, after(0.1 * static_cast<double>(i)));
        const double most = k < 3 ? 0.03 : 2.0;
        p.x += random.uniform(3 + 2 * k, -most, most);
        p.y += random.uniform(4 + 2 * k, -most, most);
      }
    }
    hashes.insert(map.state().hash());
    forceInstructionSet("");
  }
  EXPECT_EQ(hashes.size(), 1u);
}

// A node just at the reach is within it in one stroke and by rounding not in the next.
TEST_F(Treading, GivesTheSameBitsWhereNodesLieAtTheReach) {
  MapLaw law;
  law.origin_x = law.origin_y = -10.0;
  for (const Point& way : {Point{-0.1, 0.0}, Point{0.1, 0.0}, Point{0.0, -0.1}, Point{0.05, 0.05},
                           Point{-0.05, 0.05}, Point{-0.05, -0.05}}) {
    std::set<std::uint64_t> hashes;
    for (const std::string& set : instructionSets()) {
      forceInstructionSet(set);
      TreadMap map(law, TreadSettings());
      std::uint64_t all = 0;
      for (int k = 0; k < 60; ++k) {
        map.tread(1, TreadLaw(), {way.x * k, way.y * k}, START);
        all = 31 * all + map.state().hash();
      }
      hashes.insert(all);
      forceInstructionSet("");
    }
    EXPECT_EQ(hashes.size(), 1u) << way.x << ' ' << way.y;
  }
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

}  // namespace
}  // namespace vegetation_sim::grass

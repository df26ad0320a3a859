// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/node_wind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/grass/blade_plain.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::grass {
namespace {

constexpr Nanoseconds STAMP = 1700000003 * NANOSECONDS_PER_SECOND;

wind::Primitive primitive(wind::Kind kind, std::uint32_t id, const Vec3& centre, double radius) {
  wind::Primitive p;
  p.id = id;
  p.name = "wind " + std::to_string(id);
  p.kind = kind;
  p.trajectory = {{0, centre}};
  p.radius = radius;
  p.fade_in = 0.0;
  return p;
}

wind::Field everyKind() {
  std::vector<wind::Primitive> out{primitive(wind::Kind::DISK, 1, Vec3(30, 30, 0), 12.0),
                                   primitive(wind::Kind::BREEZE, 2, Vec3::Zero(), 10.0),
                                   primitive(wind::Kind::GUST, 3, Vec3(20, 70, 0), 15.0),
                                   primitive(wind::Kind::TORNADO, 4, Vec3(70, 30, 0), 10.0),
                                   primitive(wind::Kind::BLAST, 5, Vec3(50, 80, 2), 8.0),
                                   primitive(wind::Kind::WAKE, 6, Vec3(90, 90, 3), 4.0)};
  out[0].phase = 1.0;
  out[2].epoch = STAMP - 4 * NANOSECONDS_PER_SECOND;
  out[2].velocity = Vec3(3, -4, 0);
  out[5].trajectory = {{STAMP, Vec3(90, 90, 3)},
                       {STAMP + 5 * NANOSECONDS_PER_SECOND, Vec3(60, 50, 3)}};
  return wind::Field(out, 5);
}

constexpr TileWindow ALL{0, 49, 0, 49};

// S2-19, S2-20: grass and trees ask the same law: at a node on the ground the air is the wind's, to
// the bit, whatever blows; so every gust passes both at the same time.
TEST(NodeWind, IsTheWindOfTheTreesBitByBit) {
  const FeatureMap map;
  const terrain::HeightMap hill = slopedGround(0.2, 0.1);
  NodeWind air(map, hill);
  for (const double second : {0.0, 0.7, 3.1}) {
    const wind::Instant wind = everyKind().at(STAMP + fromSeconds(second));
    air.update(wind, {}, ALL);
    for (int row = 0; row <= 50; ++row)
      for (int column = 0; column <= 50; ++column) {
        const Vec3 place(2.0 * column, 2.0 * row, hill.height(2.0 * column, 2.0 * row));
        ASSERT_EQ(air.at(column, row), wind.velocity(place)) << column << ' ' << row;
      }
  }
}

// S2-17: only the nodes under a mask are touched; their number is the mask's area.
TEST(NodeWind, TouchesOnlyTheNodesUnderAMask) {
  const FeatureMap map;
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  auto disk = primitive(wind::Kind::DISK, 1, Vec3(50, 50, 0), 20.0);
  disk.phase = 1.0;
  const wind::Instant wind = wind::Field({disk}).at(STAMP);
  air.update(wind, {}, ALL);
  int inside = 0;
  for (int row = 0; row <= 50; ++row)
    for (int column = 0; column <= 50; ++column) {
      const bool covered = std::hypot(2.0 * column - 50.0, 2.0 * row - 50.0) < 20.0;
      inside += covered;
      EXPECT_EQ(!air.at(column, row).isZero(0.0), covered);
    }
  EXPECT_EQ(air.touched(), inside);
  EXPECT_NEAR(air.touched(), 3.14159 * 20.0 * 20.0 / 4.0, 12.0);  // nodes of 4 m^2
  // A window far from it, or none at all, is left alone.
  air.update(wind, {}, {0, 3, 0, 3});
  EXPECT_EQ(air.touched(), 0);
  air.update(wind, {}, {});
  EXPECT_EQ(air.touched(), 0);
}

// S2-18: displacements add, colours average.
TEST(NodeWind, AddsDisplacementsAndAveragesColours) {
  MapInput input;
  input.colour.value = 0.2;
  const FeatureMap map(input);
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  std::vector<wind::Primitive> discs{primitive(wind::Kind::DISK, 1, Vec3(50, 50, 0), 20.0),
                                     primitive(wind::Kind::DISK, 2, Vec3(50, 50, 0), 30.0)};
  for (auto& disc : discs) disc.phase = 1.0;
  discs[1].velocity = Vec3(0, 3, 0);
  const auto alone = [&](std::size_t i) {
    return wind::Field({discs[i]}).at(STAMP).velocity(Vec3(50, 50, 0));
  };
  air.update(wind::Field(discs).at(STAMP), {{{50, 50}, 5.0, 0.8, 1.0}, {{50, 50}, 9.0, 0.5, 1.0}},
             ALL);
  EXPECT_LT((air.at(25, 25) - (alone(0) + alone(1))).norm(), 1e-15);
  EXPECT_NEAR(air.colourAt(25, 25), (0.2 + 0.8 + 0.5) / 3.0, 1e-15);
  EXPECT_EQ(air.colourAt(10, 10), 0.2);
  const double edge = air.colourAt(28, 25);  // 6 m off: only the second, weaker
  EXPECT_GT(edge, 0.2);
  EXPECT_LT(edge, 0.35);
}

// S2-18, S2-W4, E16: sums follow their causes while small, and stay below 86 degrees in any storm.
TEST(NodeWind, BendIsBounded) {
  const Point small = bendIn(Vec3(3, -4, 9), 0.07);
  EXPECT_NEAR(small.x, 0.21, 1e-15);
  EXPECT_NEAR(small.y, -0.28, 1e-15);
  double before = 0.0;
  for (double speed = 1.0; speed < 1e4; speed *= 1.5) {
    const Point bend = bendIn(Vec3(0.6 * speed, 0.8 * speed, 0), 0.07);
    const double size = std::hypot(bend.x, bend.y);
    EXPECT_GT(size, before);
    EXPECT_LT(size, BEND_LIMIT);
    EXPECT_NEAR(bend.x / size, 0.6, 1e-12);
    before = size;
  }
}

// S2-18: on blades: two winds together bend a blade by the sum of what each does.
TEST(NodeWind, BladesBendByTheSumOfWinds) {
  Tile tile = tileOf({100.f, 100.f, 100.f, 100.f});
  tile.shape = {0.f, 0.f, 0.f, 0.f};  // upright at rest
  const auto tipOf = [&](float x, float y) {
    TileMotion motion;
    motion.wind_x.fill(x);
    motion.wind_y.fill(y);
    const ReferenceBlade blade = poseReference(tile, motion, 7);
    const double reach_x = blade.x[LINKS] - blade.x[0], reach_y = blade.y[LINKS] - blade.y[0];
    const double reach = std::hypot(reach_x, reach_y), rise = blade.z[LINKS] - blade.z[0];
    const double bend = 2.0 * std::atan2(reach, rise);  // of an arc, twice its chord's tilt
    return Point{bend * reach_x / reach, bend * reach_y / reach};
  };
  const Point a = tipOf(4.f, 0.f), b = tipOf(2.f, 5.f), both = tipOf(6.f, 5.f);
  EXPECT_NEAR(both.x, a.x + b.x, 2e-3);  // five chords are not quite an arc
  EXPECT_NEAR(both.y, a.y + b.y, 2e-3);
}

// S2-20: a gust's front moves on, a tornado turns and sucks, a breeze stays low.
TEST(NodeWind, ShowsGustTornadoAndBreeze) {
  const FeatureMap map;
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  auto gust = primitive(wind::Kind::GUST, 1, Vec3(10, 50, 0), 60.0);
  gust.epoch = STAMP;
  const wind::Field front({gust});
  const auto reached = [&](double second) {
    air.update(front.at(STAMP + fromSeconds(second)), {}, ALL);
    int column = 50;
    while (column > 0 && air.at(column, 25).isZero(0.0)) --column;
    return 2.0 * column;
  };
  EXPECT_NEAR(reached(8.0) - reached(3.0), 5.0 * gust.front_speed, 2.0);
  const wind::Field eddy({primitive(wind::Kind::TORNADO, 1, Vec3(50, 50, 0), 20.0)});
  air.update(eddy.at(STAMP), {}, ALL);
  EXPECT_GT(air.at(27, 25).y(), 1.0);   // east of it the air goes north
  EXPECT_LT(air.at(27, 25).x(), -0.1);  // and inward
  const wind::Field breeze({primitive(wind::Kind::BREEZE, 1, Vec3::Zero(), 1.0)});
  air.update(breeze.at(STAMP), {}, ALL);
  EXPECT_NEAR(air.at(3, 3).x(), 5.0, 4.0);
}

// N11: a hovering body's downwash bends grass outward and moves with it.
TEST(NodeWind, DownwashBendsOutwardAndMovesAlong) {
  MapInput input;
  input.law.resolution = 0.5;
  const FeatureMap map(input);
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  for (const double x : {8.0, 14.0}) {
    auto wash = primitive(wind::Kind::BLAST, 1, Vec3(x, 10, 1.0), 4.0);
    wash.core_radius = 1.0;
    air.update(wind::Field({wash}).at(STAMP), {}, {0, 49, 0, 49});
    for (int k = 0; k < 12; ++k) {
      const double angle = 0.5 * k;
      const int column = static_cast<int>(std::lround((x + 2.0 * std::cos(angle)) / 0.5));
      const int row = static_cast<int>(std::lround((10.0 + 2.0 * std::sin(angle)) / 0.5));
      const Vec3 out(0.5 * column - x, 0.5 * row - 10.0, 0.0), a = air.at(column, row);
      EXPECT_GT(a.x() * out.x() + a.y() * out.y(), 0.99 * std::hypot(a.x(), a.y()) * out.norm());
      EXPECT_GT(std::hypot(a.x(), a.y()), 1.0);
    }
  }
}

// N11: a wake bends grass along the motion of its body, behind it only.
TEST(NodeWind, WakeBendsAlongTheMotionBehindTheBody) {
  const FeatureMap map;
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  auto wake = primitive(wind::Kind::WAKE, 1, Vec3::Zero(), 1.5);
  wake.trajectory = {{STAMP, Vec3(60, 50, 0.5)},
                     {STAMP + NANOSECONDS_PER_SECOND, Vec3(50, 50, 0.5)}};
  air.update(wind::Field({wake}).at(STAMP), {}, ALL);
  for (int column = 0; column <= 50; ++column) {
    const Vec3 a = air.at(column, 25);
    EXPECT_EQ(a.x() < 0.0, column >= 30 && column <= 47) << column;  // up to 35 m behind
    EXPECT_EQ(a.y(), 0.0);
  }
  EXPECT_GT(air.touched(), 50);
  EXPECT_LT(air.touched(), 300);
}

// S2-17: a viewer's tiles may be all that is asked for; those get the same air.
TEST(NodeWind, CanBeRestrictedToSomeTiles) {
  const FeatureMap map;
  const terrain::HeightMap flat;
  NodeWind all(map, flat), some(map, flat);
  const wind::Instant wind = everyKind().at(STAMP);
  const std::vector<TilePlace> tiles{{14, 15}, {20, 11}};
  all.update(wind, {}, {10, 20, 10, 20});
  some.update(wind, {}, {10, 20, 10, 20}, &tiles);
  for (const TilePlace& tile : tiles)
    for (int corner = 0; corner < 4; ++corner) {
      const int column = tile.column + corner % 2, row = tile.row + corner / 2;
      EXPECT_EQ(some.at(column, row), all.at(column, row));
    }
  EXPECT_LE(some.touched(), 8 * 4);
}

TEST(NodeWind, FillsTheCornersOfATile) {
  const FeatureMap map;
  const terrain::HeightMap flat;
  NodeWind air(map, flat);
  air.update(everyKind().at(STAMP), {{{30, 30}, 9.0, 1.0, 1.0}}, {10, 20, 10, 20});
  Tile tile = makeTile(map, flat, 1, 14, 15);
  TileMotion motion;
  air.fill(tile, motion);
  EXPECT_EQ(motion.wind_x[0], static_cast<float>(air.at(14, 15).x()));
  EXPECT_EQ(motion.wind_x[1], static_cast<float>(air.at(15, 15).x()));
  EXPECT_EQ(motion.wind_y[2], static_cast<float>(air.at(14, 16).y()));
  EXPECT_EQ(tile.colour[3], static_cast<float>(air.colourAt(15, 16)));
  EXPECT_GT(tile.colour[0], 0.f);
}

}  // namespace
}  // namespace vegetation_sim::grass

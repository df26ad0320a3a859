// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/cut_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error_text.h"
#include "reference/grass/blade_plain.h"
#include "scenes/grass/tread_simulation_fixture.h"

namespace vegetation_sim::grass {
namespace {

constexpr double SPACING = 0.05, PI = 3.14159265358979;

CutArea box(double x0, double y0, double x1, double y1, double height = 0.06) {
  CutArea out;
  out.outline = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  out.height = height;
  return out;
}

CutArea disc(double x, double y, double radius, double height = 0.06) {
  CutArea out;
  out.outline = {{x, y}};
  out.radius = radius;
  out.height = height;
  return out;
}

double cutArea(const CutMap& map) {
  double nodes = 0.0;
  for (const auto& [place, block] : map.state().blocks)
    for (const CutNode& node : block.nodes) nodes += node.height < UNCUT ? 1.0 : 0.0;
  return nodes * SPACING * SPACING;
}

// Mass of all cut grass on the ground [kg].
double laidMass(const CutMap& map) {
  double sum = 0.0;
  for (const auto& [place, block] : map.state().blocks)
    for (const CutNode& node : block.nodes) sum += node.swath;
  return sum * SPACING * SPACING;
}

class CutTest : public FieldTest {
 protected:
  const FeatureMap& features() const { return *layout_.map; }
  const CutMap& cuts() const { return map_.cuts(); }
};

TEST_F(CutTest, TheCutAreaIsThatOfTheOutlineWithinHalfARowOfNodes) {
  struct Case {
    CutArea area;
    double size, edge;
  };
  CutArea corner;  // not convex
  corner.outline = {{3.01, 3.02}, {8.33, 3.02}, {8.33, 5.04},
                    {5.57, 5.04}, {5.57, 9.46}, {3.01, 9.46}};
  CutArea capsule = disc(4.0, 4.0, 1.1);
  capsule.outline.push_back({9.3, 11.7});
  const double long_way = std::sqrt(5.3 * 5.3 + 7.7 * 7.7);
  for (const Case& c : {Case{box(2.013, 3.027, 7.431, 9.119), 5.418 * 6.092, 2 * (5.418 + 6.092)},
                        Case{disc(10.0, 10.0, 3.3), PI * 3.3 * 3.3, 2 * PI * 3.3},
                        Case{corner, 5.32 * 2.02 + 2.56 * 4.42, 2 * (5.32 + 6.44)},
                        Case{capsule, PI * 1.21 + 2.2 * long_way, 2 * PI * 1.1 + 2 * long_way}}) {
    map_.clear();
    field_.cut(c.area);
    EXPECT_NEAR(cutArea(cuts()), c.size, 0.5 * SPACING * c.edge);
    EXPECT_GT(cutArea(cuts()), 0.0);
  }
}

TEST_F(CutTest, ANodeIsCutIfItIsInside) {
  field_.cut(box(2.013, 3.027, 7.431, 9.119));
  for (double x = 1.0; x < 9.0; x += SPACING)
    for (double y = 2.0; y < 10.0; y += 5 * SPACING) {
      const bool inside = x > 2.013 && x < 7.431 && y > 3.027 && y < 9.119;
      EXPECT_EQ(cuts().at({x, y}).height, inside ? 0.06f : UNCUT) << x << ", " << y;
    }
}

TEST_F(CutTest, NeighbouringAreasShareNoNode) {
  field_.cut(box(2.0, 2.0, 4.0, 4.0));
  const double first = cutArea(cuts());
  field_.cut(box(4.0, 2.0, 6.0, 4.0, 0.05));
  EXPECT_NEAR(cutArea(cuts()), 2.0 * first, 1e-9);
  EXPECT_EQ(cuts().at({3.95, 3.0}).height, 0.06f);
}

TEST_F(CutTest, TheLowestCutCounts) {
  field_.cut(disc(10.0, 10.0, 2.0, 0.08));
  const double mass = laidMass(cuts());
  EXPECT_EQ(field_.cut(disc(10.0, 10.0, 2.0, 0.1)), 0.0);
  EXPECT_EQ(laidMass(cuts()), mass);
  EXPECT_EQ(cuts().at({10.0, 10.0}).height, 0.08f);
  EXPECT_GT(field_.cut(disc(10.0, 10.0, 1.0, 0.04)), 0.0);
  EXPECT_EQ(cuts().at({10.0, 10.0}).height, 0.04f);
  EXPECT_EQ(cuts().at({11.5, 10.0}).height, 0.08f);
}

TEST_F(CutTest, WhatIsAboveTheGrassCutsNothing) {
  EXPECT_EQ(field_.cut(disc(10.0, 10.0, 2.0, 0.31)), 0.0);
  EXPECT_TRUE(cuts().state().empty());
}

TEST_F(CutTest, TheSwathHasTheMassThatIsRemoved) {
  double removed = 0.0, expected = 0.0;
  for (int i = 0; i < 20; ++i) {
    CutArea area = box(3.0 + 0.4 * i, 5.0, 3.6 + 0.4 * i, 7.0, 0.05);
    area.swath = box(2.2 + 0.4 * i, 5.7, 2.8 + 0.4 * i, 6.3).outline;
    removed += field_.cut(area);
  }
  const Features here = features().at(5.0, 6.0);
  expected = cutArea(cuts()) *
             (massBelow(features(), here, 1e9) - massBelow(features(), here, double{0.05f}));
  EXPECT_GT(removed, 0.1);
  EXPECT_NEAR(removed, expected, 1e-6 * removed);
  EXPECT_NEAR(laidMass(cuts()), removed, 1e-6 * removed);
  EXPECT_EQ(cuts().at({8.0, 5.2}).swath, 0.0);  // beside the swath
  EXPECT_GT(cuts().at({8.0, 6.0}).swath, 0.0);
}

// The swath of a tool at the border is not lost, nor is that of a swath without a node.
TEST_F(CutTest, NoMassIsLostAtTheBorder) {
  CutArea area = box(0.0, 5.0, 0.5, 6.0);
  area.swath = box(-3.0, 5.0, -2.0, 6.0).outline;
  double removed = field_.cut(area);
  area = box(4.0, 5.0, 4.5, 6.0);
  area.swath = box(6.01, 6.01, 6.02, 6.02).outline;
  removed += field_.cut(area);
  EXPECT_NEAR(laidMass(cuts()), removed, 1e-12);
  EXPECT_GT(removed, 0.0);
}

// The mass law against the blades themselves.
TEST_F(CutTest, TheMassIsThatOfTheDrawnBlades) {
  const Tile tile = makeTile(features(), terrain::HeightMap(), 7, 3, 5);
  const double width = features().species()[0].species.width;
  for (const double height : {0.02, 0.2, 0.28, 1e9}) {
    double sum = 0.0;
    for (int blade = 0; blade < tile.blades; ++blade)
      sum += std::min(height, double{traitsOf(tile, blade).length});
    const double area = double{tile.size} * double{tile.size};
    const double mass = massBelow(features(), features().at(tile.x + 1.0, tile.y + 1.0), height);
    EXPECT_NEAR(LEAF_MASS * width * sum / area, mass, 0.01 * mass) << height;
  }
}

// Stubble height exact: the longest blades have the height of the cut, shorter ones their own.
TEST_F(CutTest, BladesAreNoLongerThanTheCut) {
  field_.cut(box(0.0, 0.0, 20.0, 20.0, 0.06));
  CrushPatch patch;
  map_.patch(3, 5, now(), patch);
  ASSERT_GT(patch.cells, 0);
  const Tile tile = makeTile(features(), terrain::HeightMap(), 7, 3, 5);
  TileMotion motion;
  motion.crush = &patch;
  std::vector<BladeBlock> blocks(static_cast<std::size_t>(blocksFor(tile.blades)));
  std::vector<BladeBlock> plain = blocks;
  poseBlades(tile, motion, tile.blades, blocks.data());
  poseBladesPlain(tile, motion, tile.blades, plain.data());
  for (int blade = 0; blade < tile.blades; ++blade) {
    const BladeBlock& b = blocks[static_cast<std::size_t>(blade / BLOCK)];
    const BladeBlock& p = plain[static_cast<std::size_t>(blade / BLOCK)];
    const int lane = blade % BLOCK;
    double way = 0.0;
    for (int i = 1; i < POINTS; ++i) {
      ASSERT_EQ(b.z[i][lane], p.z[i][lane]);
      way += std::sqrt(std::pow(double{b.x[i][lane]} - double{b.x[i - 1][lane]}, 2) +
                       std::pow(double{b.y[i][lane]} - double{b.y[i - 1][lane]}, 2) +
                       std::pow(double{b.z[i][lane]} - double{b.z[i - 1][lane]}, 2));
    }
    EXPECT_NEAR(way, std::min(0.06, double{traitsOf(tile, blade).length}), 1e-4);
  }
}

TEST_F(CutTest, StubbleHasLessDrag) {
  const double before = field_.resistanceAt({10.0, 10.0}, now());
  field_.cut(disc(10.0, 10.0, 1.0, 0.06));
  EXPECT_NEAR(field_.resistanceAt({10.0, 10.0}, now()), before * double{0.06f} / 0.3, 1e-9);
  EXPECT_EQ(field_.resistanceAt({14.0, 10.0}, now()), before);
}

TEST_F(CutTest, ClearingRaisesTroddenButNotCutGrass) {
  field_.cut(disc(10.0, 10.0, 1.0));
  field_.raiseAll();
  EXPECT_EQ(cuts().at({10.0, 10.0}).height, 0.06f);
  field_.reset();
  EXPECT_TRUE(cuts().state().empty());
}

TEST_F(CutTest, AReplicaGetsTheSameGround) {
  TreadMap shown = makeMap();
  TreadReplica replica;
  replica.apply(field_.update(true), shown);
  for (int i = 0; i < 5; ++i) {
    CutArea area = box(3.0 + 0.3 * i, 5.0, 3.6 + 0.3 * i, 7.0);
    area.swath = box(2.0 + 0.3 * i, 5.5, 2.6 + 0.3 * i, 6.5).outline;
    field_.cut(area);
    const TreadUpdate update = field_.update(false);
    EXPECT_FALSE(update.treads.cuts.empty());
    ASSERT_TRUE(replica.apply(update, shown));
  }
  EXPECT_TRUE(field_.update(false).treads.cuts.empty());
  const TreadUpdate key = field_.update(true);
  TreadDelta copy;
  copy.cuts = snapshotCuts(shown.cuts().state());
  EXPECT_EQ(hashOf(copy), key.hash);
  EXPECT_NE(key.hash, 0u);
}

TEST_F(CutTest, ASnapshotContinuesWithTheSameHash) {
  field_.cut(disc(10.0, 10.0, 1.0));
  TreadMap other = makeMap();
  TreadSimulation continued = makeField(other);
  const TreadSnapshot read = continued.readArchived(field_.archived());
  EXPECT_EQ(read.hash(), field_.snapshot().hash());
  continued.restore(read);
  for (TreadSimulation* field : {&field_, &continued}) field->cut(box(9.5, 9.0, 12.0, 12.0, 0.03));
  EXPECT_EQ(continued.snapshot().hash(), field_.snapshot().hash());
  TreadMap fresh = makeMap();
  EXPECT_NE(makeField(fresh).snapshot().hash(), field_.snapshot().hash());
}

TEST_F(CutTest, TheMemoryCapLeavesNodesUncut) {
  CutMap small(mapLaw(), 40, 30e3);
  const double removed = small.cut(features(), box(0.0, 0.0, 20.0, 20.0));
  EXPECT_LE(small.bytes(), 30000u);
  EXPECT_GT(small.state().no_memory, 100000u);
  EXPECT_NEAR(laidMass(small), removed, 1e-6 * removed);
}

TEST_F(CutTest, FaultsAreNamed) {
  const auto faultOf = [](const CutArea& area) {
    Faults faults;
    check(area, "cut: ", faults);
    return faults.empty() ? std::string() : faults.list().front();
  };
  EXPECT_EQ(faultOf(box(0, 0, 1, 1)), "");
  EXPECT_EQ(faultOf(CutArea()),
            "cut: outline has 0 points, allowed are 3 to 1000, or 1 with a radius");
  CutArea area = disc(0.0, 0.0, 1.0);
  area.outline[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faultOf(area), "cut: outline[0].x = nan m is not finite, allowed is -1e+07 to 1e+07 m");
  EXPECT_EQ(faultOf(disc(0.0, 0.0, 2000.0)), "cut: radius = 2000 m is outside 0 to 1000 m");
  EXPECT_EQ(faultOf(disc(0.0, 0.0, 1.0, -0.1)), "cut: height = -0.1 m is outside 0 to 5 m");
  area = disc(0.0, 0.0, 1.0);
  area.swath = {{0.0, 0.0}};
  EXPECT_EQ(faultOf(area), "cut: swath has 1 points, allowed are 3 to 1000, or 1 with a radius");
}

TEST(CutMapTest, TooMuchWorkIsRefusedAndChangesNothing) {
  MapInput input;
  input.law.columns = input.law.rows = 101;
  const FeatureMap features(input);
  CutMap map(input.law, 40, 1e9);
  EXPECT_EQ(errorOf([&] { map.cut(features, box(0.0, 0.0, 200.0, 200.0)); }),
            "cut: 16024005 nodes and corners of rows to visit, allowed are 2000000");
  EXPECT_TRUE(map.state().empty());
}

}  // namespace
}  // namespace vegetation_sim::grass

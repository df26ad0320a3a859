// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "core/error_text.h"
#include "scenes/canopy/canopy_scene.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::canopy {
namespace {

/// A box whose lowest point is 0.3 m above the ground drives along the row of the two shrubs.
forest::Body barAt(double x, Nanoseconds stamp) {
  forest::Body out;
  out.id = out.frame = "robot";
  out.shape = forest::Shape::BOX;
  out.size = Vec3(0.6, 0.5, 0.4);
  out.pose.position = Vec3(x, 0.2, 0.5);
  out.velocity = Vec3(1.5, 0.0, 0.0);
  out.stamp = stamp;
  return out;
}

// Drives through both shrubs. Returns the largest force.
double driveThrough(Canopy& canopy) {
  double out = 0.0;
  for (int tick = 10; tick < 110; ++tick) {
    canopy.setBody(barAt(-2.0 + 0.05 * (tick - 10), tickStamp(tick)));
    canopy.advance(tickStamp(tick));
    for (const PushForce& force : canopy.pushForces()) out = std::max(out, length(force.force));
  }
  return out;
}

TEST(CanopyCut, TheLowestCutCountsAndEachPieceIsTold) {
  Canopy canopy(shrubScene());
  const std::vector<CutPiece> first = canopy.cut({0, 1}, 0.9);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[1].plant, 1U);
  EXPECT_DOUBLE_EQ(first[1].length, 1.6 - 0.9);
  EXPECT_TRUE(canopy.cut({0, 1}, 1.2).empty());
  EXPECT_TRUE(canopy.cut({0, 1}, 0.9).empty());
  const std::vector<CutPiece> second = canopy.cut({1}, 0.2);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_DOUBLE_EQ(second[0].length, 0.9 - 0.2);
  EXPECT_EQ(canopy.snapshot().push.stubble, (Stubble{{0, 0.9}, {1, 0.2}}));
  EXPECT_EQ(canopy.foliage().cutHeight(1), 0.2);
  canopy.reset();
  EXPECT_EQ(canopy.foliage().cutHeight(1), UNCUT);
}

TEST(CanopyCut, BadCutsChangeNothing) {
  Canopy canopy(shrubScene());
  EXPECT_NE(errorOf([&] {
              canopy.cut({0, 2}, 0.5);
            }).find("plant 2: there are 2 plants"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { canopy.cut({0}, 6.0); }).find("height = 6 m is outside 0 to 5 m"),
            std::string::npos);
  EXPECT_TRUE(canopy.snapshot().push.stubble.empty());
}

TEST(CanopyCut, ATrellisStays) {
  Layout layout = shrubScene();
  layout.kinds[0].shape = PlantShape::TRELLIS;
  Canopy canopy(layout);
  EXPECT_FALSE(canopy.canCut(0, 0.1));
  EXPECT_TRUE(canopy.cut({0}, 0.1).empty());
}

// Hashes that were recorded before there were cuts stay valid.
TEST(CanopyCut, OnlyACutChangesTheHash) {
  Canopy canopy(shrubScene()), same(shrubScene()), cut(shrubScene());
  for (Canopy* each : {&canopy, &same, &cut}) run(*each, 0, 5);
  same.cut({0}, 3.0);
  cut.cut({0}, 0.5);
  EXPECT_EQ(same.snapshot().hash(), canopy.snapshot().hash());
  EXPECT_NE(cut.snapshot().hash(), canopy.snapshot().hash());
}

// A body presses fibres up to half a cell, 0.125 m, beyond its surface.
TEST(CanopyCut, StubbleBelowABodyDoesNotPushIt) {
  std::vector<double> forces;
  for (const double height : {5.0, 0.5, 0.15, 0.0}) {
    Canopy canopy(shrubScene());
    run(canopy, 0, 10);
    canopy.cut({0, 1}, height);
    forces.push_back(driveThrough(canopy));
  }
  EXPECT_GT(forces[0], 20.0);
  EXPECT_GT(forces[1], 1.0);
  EXPECT_LT(forces[1], forces[0]);
  EXPECT_EQ(forces[2], 0.0);
  EXPECT_EQ(forces[3], 0.0);
}

TEST(CanopyCut, APlantThatLeansAndIsCutAtItsFootLeansNoLonger) {
  Canopy canopy(shrubScene());
  run(canopy, 0, 10);
  driveThrough(canopy);
  ASSERT_FALSE(canopy.snapshot().push.plants.empty());
  const std::uint32_t leans = canopy.snapshot().push.plants.begin()->first;
  canopy.cut({leans}, 0.0);
  EXPECT_EQ(canopy.snapshot().push.plants.count(leans), 0U);
}

TEST(CanopyCut, ASnapshotContinuesWithTheSameHashes) {
  Canopy canopy(shrubScene());
  run(canopy, 0, 10);
  canopy.cut({1}, 0.4);
  Canopy other(canopy.layout());
  const Canopy::Archived read = other.readArchived(canopy.archived());
  other.restore(read.snapshot);
  EXPECT_EQ(other.foliage().cutHeight(1), 0.4);
  EXPECT_EQ(other.archived(), canopy.archived());
  EXPECT_EQ(driveThrough(other), driveThrough(canopy));
  EXPECT_EQ(other.snapshot().hash(), canopy.snapshot().hash());
  CanopySnapshot wrong = read.snapshot;
  wrong.push.stubble[7] = 0.1;
  EXPECT_NE(errorOf([&] { other.restore(wrong); }).find("snapshot: cut of plant 7"),
            std::string::npos);
}

TEST(CanopyCut, AReplicaKnowsTheCutsOfTheLastList) {
  Canopy canopy(shrubScene());
  Replica early(canopy.layout()), late(canopy.layout());
  const auto advance = [&](int tick, bool listed, std::initializer_list<Replica*> receivers) {
    run(canopy, tick, tick + 1);
    for (Replica* each : receivers) each->apply(canopy.update(false, listed));
  };
  advance(0, false, {&early});  // before the first tick nothing has been cut
  EXPECT_TRUE(early.exact());
  canopy.cut({1}, 0.4);
  advance(1, true, {&early});
  for (int tick = 2; tick < 50; ++tick) advance(tick, false, {&early, &late});
  EXPECT_EQ(early.cutHeight(1), 0.4);
  EXPECT_EQ(early.foliage().cutHeight(1), 0.4);
  EXPECT_EQ(early.foliageOfPlane().cutHeight(1), 0.4);
  EXPECT_TRUE(early.exact());
  EXPECT_FALSE(late.exact());
  advance(50, true, {&late});
  EXPECT_TRUE(late.exact());
  EXPECT_EQ(late.cutHeight(1), 0.4);
  // A message is lost, which may have had a cut.
  advance(52, false, {&early});
  EXPECT_EQ(early.cutHeight(1), 0.4);
  for (int tick = 53; tick < 100; ++tick) advance(tick, false, {&early});
  EXPECT_FALSE(early.exact());
  StateUpdate wrong = canopy.update(false);
  wrong.stubble = Stubble{{9, 0.1}};
  EXPECT_NE(errorOf([&] { early.apply(wrong); }).find("state: cut of plant 9"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::canopy

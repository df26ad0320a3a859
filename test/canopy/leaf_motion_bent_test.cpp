// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Leaves and stems of plants that bodies push, in the animator and in a replica.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "scenes/canopy/canopy_scene.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::canopy {
namespace {

/// A box, 0.8 m high, that drives along the row of the two shrubs.
forest::Body robotAt(double x, Nanoseconds stamp) {
  forest::Body out;
  out.id = out.frame = "robot";
  out.shape = forest::Shape::BOX;
  out.size = Vec3(0.6, 0.5, 0.8);
  out.pose.position = Vec3(x, 0.2, 0.5);
  out.velocity = Vec3(1.5, 0.0, 0.0);
  out.stamp = stamp;
  return out;
}

// Drives from tick `from` to before tick `to`; the robot meets the first shrub at tick 20.
void drive(Canopy& canopy, int from, int to, Replica* replica = nullptr) {
  for (int tick = from; tick < to; ++tick) {
    canopy.setBody(robotAt(-2.0 + 0.05 * tick, tickStamp(tick)));
    canopy.advance(tickStamp(tick));
    if (replica) replica->apply(canopy.update(false));
  }
}

std::vector<Leaf> leavesOf(const Layout& layout, std::size_t plant) {
  return grow(layout.kinds[0], layout.plants[plant]).leaves;
}

TEST(BentLeaves, LeavesGoAsideAndAReplicaMovesThemToTheSameBits) {
  for (const bool windy : {false, true}) {
    Canopy canopy(shrubScene());
    if (windy) canopy.setWind(breezeFrom(Vec3(2.0, 3.0, 0.0)));
    Replica replica(canopy.layout());
    drive(canopy, 0, 45, &replica);
    EXPECT_TRUE(canopy.foliage().isBent(0));
    double most = 0.0;
    for (std::size_t plant = 0; plant < 2; ++plant)
      for (const Leaf& leaf : leavesOf(canopy.layout(), plant)) {
        const MovedLeaf here = canopy.foliage().move(leaf, plant);
        const MovedLeaf there = replica.foliage().move(leaf, plant);
        ASSERT_EQ(here.root, there.root);
        ASSERT_EQ(here.tip, there.tip);
        ASSERT_EQ(here.side, there.side);
        ASSERT_EQ(replica.foliageOfPlane().isBent(plant), canopy.foliage().isBent(plant));
        most = std::max(most, here.root.x() - leaf.root.x());
        if (windy) continue;
        // Leaves keep their shape, and their distance from the foot of their fibre.
        EXPECT_NEAR(length(Vec3(here.tip - here.root)), length(Vec3(leaf.tip - leaf.root)), 1e-12);
        const Vec3 foot(leaf.anchor.x(), leaf.anchor.y(),
                        canopy.layout().plants[plant].position.z());
        EXPECT_NEAR(length(Vec3(here.root - foot)), length(Vec3(leaf.root - foot)), 1e-12);
      }
    EXPECT_GT(most, 0.2);
    EXPECT_LT(canopy.pushForces().at(0).force.x(), -1.0);
  }
}

TEST(BentLeaves, TheDisplacementOfAPointIsThatOfTheCellThere) {
  Canopy canopy(shrubScene());
  drive(canopy, 0, 45);
  const Fibres fibres = fibresOf(canopy.layout().kinds[0], canopy.layout().plants[0]);
  const std::vector<Cluster>& clusters = canopy.snapshot().push.plants.at(0);
  for (std::size_t cell = 0; cell < fibres.cells(); ++cell) {
    const Vec3 point = fibres.footOf(cell) + Vec3(0.0, 0.0, 1.0);
    const Flat& lean = clusters[cell].lean;
    const double angle = lean.size(), part = angle > 0.0 ? std::sin(angle) / angle : 0.0;
    const Vec3 expected(part * lean.x, part * lean.y, std::cos(angle) - 1.0);
    EXPECT_LT(length(Vec3(canopy.foliage().displacement(point, point, 0) - expected)), LEAN_UNIT);
    EXPECT_LT(length(Vec3(canopy.foliage().bend(point, 0) - point - expected)), LEAN_UNIT);
  }
}

TEST(BentLeaves, ASnapshotContinuesWithTheSameHashes) {
  Canopy canopy(shrubScene());
  drive(canopy, 0, 40);
  Canopy other(canopy.layout());
  const Canopy::Archived read = other.readArchived(canopy.archived());
  other.restore(read.snapshot);
  EXPECT_EQ(other.snapshot().hash(), canopy.snapshot().hash());
  EXPECT_EQ(other.archived(), canopy.archived());
  drive(canopy, 40, 60);
  drive(other, 40, 60);
  EXPECT_EQ(other.snapshot().hash(), canopy.snapshot().hash());
  Layout smaller = canopy.layout();
  smaller.kinds[0].push.cell = 0.5;
  Canopy wrong(smaller);
  EXPECT_NE(errorOf([&] { wrong.restore(read.snapshot); }).find("cells belongs to another layout"),
            std::string::npos);
  smaller = canopy.layout();
  smaller.kinds[0].push.stiffness = 0.0;
  Canopy rigid(smaller);
  EXPECT_NE(errorOf([&] { rigid.restore(read.snapshot); }).find("cells belongs to another layout"),
            std::string::npos);
}

TEST(BentLeaves, WithoutATouchTheStateIsThatWithoutBodies) {
  Canopy canopy(shrubScene()), alone(shrubScene());
  canopy.setBody(robotAt(-30.0, tickStamp(0)));
  run(canopy, 0, 10);
  run(alone, 0, 10);
  EXPECT_NE(canopy.snapshot().hash(), alone.snapshot().hash());  // it has the body
  canopy.removeBody("robot");
  EXPECT_EQ(canopy.snapshot().hash(), alone.snapshot().hash());
  drive(canopy, 10, 60);
  canopy.reset();
  alone.reset();
  run(canopy, 60, 70);
  run(alone, 60, 70);
  EXPECT_EQ(canopy.snapshot().hash(), alone.snapshot().hash());
  EXPECT_FALSE(canopy.foliage().anyBent());
}

TEST(BentLeaves, BadBodiesAreRejectedByFieldValueAndRange) {
  Canopy canopy(shrubScene());
  forest::Body body = robotAt(0.0, 0);
  body.size.x() = 0.0;
  body.velocity.y() = 1e3;
  const std::string text = errorOf([&] { canopy.setBody(body); });
  EXPECT_NE(text.find("body 'robot'.size_x = 0 m is outside 0.001 to 50"), std::string::npos)
      << text;
  EXPECT_NE(text.find("velocity.y = 1000 m/s is outside -100 to 100"), std::string::npos) << text;
  EXPECT_NE(errorOf([&] { canopy.removeBody("robot"); }).find("body 'robot' is unknown"),
            std::string::npos);
  for (std::size_t i = 0; i < MOST_PUSHING; ++i) {
    body = robotAt(0.0, 0);
    body.id = std::to_string(i);
    canopy.setBody(body);
  }
  EXPECT_NE(
      errorOf([&] { canopy.setBody(robotAt(0.0, 0)); }).find("one more than the 1024 allowed"),
      std::string::npos);
  EXPECT_EQ(canopy.bodies().size(), MOST_PUSHING);
}

TEST(BentLeaves, BadCellsAreRejectedAndChangeNothing) {
  Canopy canopy(shrubScene());
  canopy.advance(tickStamp(0));
  Replica replica(canopy.layout());
  const auto refusalOf = [&](const std::vector<BentCell>& cells) {
    StateUpdate update = canopy.update(false);
    update.bent = cells;
    return errorOf([&] { replica.apply(update); });
  };
  EXPECT_NE(refusalOf({{2, 0, 1, 1}}).find("bent[0]: plant = 2 is unknown; there are 2"),
            std::string::npos);
  EXPECT_NE(refusalOf({{1, 64, 1, 1}}).find("cell = 64 is unknown; there are 64"),
            std::string::npos);
  EXPECT_NE(refusalOf({{1, 1, 1, 1}, {1, 1, 2, 1}}).find("bent[1]: plants and cells do not rise"),
            std::string::npos);
  EXPECT_NE(refusalOf({{0, 3, 0, -32000}}).find("lean = -1.6 rad is outside -1.5 to 1.5"),
            std::string::npos);
  EXPECT_FALSE(replica.foliage().anyBent());
  EXPECT_EQ(refusalOf({{0, 3, 0, -30000}, {1, 0, 30000, 0}}), "");
  EXPECT_TRUE(replica.foliage().isBent(1));
}

}  // namespace
}  // namespace vegetation_sim::canopy

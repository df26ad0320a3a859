// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/trees/tree_field.h"

#include <gtest/gtest.h>

#include <functional>

#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/lidar_scene.h"

namespace vegetation_sim::scan {
namespace {

constexpr int RAYS = 3000;
const Vec3 SENSOR(6.0, 5.0, 1.2);

Hit castAt(const Trees& trees, std::uint64_t ray) {
  Hit out;
  trees.meet(Ray(SENSOR, randomDirection(Random(1), ray, -0.1, 0.6)), out);
  return out;
}

Trees seen(const forest::ForestReplica& forest, double after) {
  Trees out;
  out.update(forest, SENSOR, 60.0, START + fromSeconds(after));
  return out;
}

// Returns the number of rays whose hits differ.
int differences(const Trees& a, const Trees& b) {
  int out = 0;
  for (std::uint64_t i = 0; i < RAYS; ++i) out += same(castAt(a, i), castAt(b, i)) ? 0 : 1;
  return out;
}

// N1
TEST(Trees, AreMetAsIfEveryBranchWereLookedAt) {
  const auto forest = movingForest(forest::gridLayout(3, 7.0), breezeOf(Vec3(6, 2, 0)));
  const Trees trees = seen(forest, 3.0);
  std::array<int, LABELS> labels{};
  for (std::uint64_t i = 0; i < RAYS; ++i) {
    Hit plain;
    meetEachBranch(trees, Ray(SENSOR, randomDirection(Random(1), i, -0.1, 0.6)), plain);
    EXPECT_TRUE(same(castAt(trees, i), plain)) << i;
    ++labels[static_cast<std::size_t>(plain.label)];
  }
  for (const Label label : {Label::NONE, Label::TRUNK, Label::BRANCH, Label::LEAF})
    EXPECT_GT(labels[static_cast<std::size_t>(label)], RAYS / 100) << static_cast<int>(label);
}

// N1. Poses in single precision against those in double precision.
TEST(Trees, BranchesStandWhereTheReplicaHasThem) {
  const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(6, 2, 0)));
  const Trees trees = seen(forest, 3.0);
  double worst = 0.0;
  for (const auto& tree : trees.all()) {
    const forest::Tree grown = forest.grow(tree->id());
    const auto poses = forest.pose(grown, tree->id(), START + fromSeconds(3.0));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Rod& rod = tree->branches()[i].rod;
      const Vec3 tip = grown.foot + tipOf(grown.skeleton.branches[i], poses[i]);
      worst = std::max(worst, length(rod.base + rod.length * rod.axis - tip));
    }
  }
  RecordProperty("worst_mm", std::to_string(1e3 * worst));
  EXPECT_LT(worst, 2e-5);
}

// N1: the same scan with the wind off and on.
TEST(Trees, InStillAirLookTheSameAndInWindDoNot) {
  const forest::Layout layout = forest::gridLayout(3, 7.0);
  const auto still = movingForest(layout, wind::Field());
  const auto windy = movingForest(layout, breezeOf(Vec3(6, 2, 0)));
  EXPECT_EQ(differences(seen(still, 3.0), seen(still, 4.0)), 0);
  EXPECT_GT(differences(seen(still, 3.0), seen(windy, 3.0)), RAYS / 10);
  EXPECT_GT(differences(seen(windy, 3.0), seen(windy, 4.0)), RAYS / 10);
}

TEST(Trees, KeptFromScanToScanAreWhereNewOnesWouldBe) {
  const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(6, 2, 0)));
  Trees kept = seen(forest, 3.0);
  kept.update(forest, SENSOR, 60.0, START + fromSeconds(9.0));
  EXPECT_EQ(differences(kept, seen(forest, 9.0)), 0);
  EXPECT_GT(differences(seen(forest, 3.0), seen(forest, 9.0)), RAYS / 10);
}

// What has come off a tree is met no more, by sensors that had seen it too; all else is.
TEST(Trees, AreMetWithoutWhatHasComeOff) {
  forest::ForestReplica forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  const Trees before = seen(forest, 0.0);
  Trees kept = seen(forest, 0.0);
  std::array<int, 4> roots{};  // the lowest limb of each tree
  forest::StateUpdate update;
  update.stamp = START;
  update.layout_hash = forest.layoutHash();
  update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
  for (std::uint32_t id = 0; id < roots.size(); ++id) {
    roots[id] = forest.grow(id).skeleton.depth_end[0];
    forest::BrokenBranch broken;
    broken.branch = roots[id];
    broken.pose.position = Vec3(1e4, 0.0, 0.0);  // the piece falls elsewhere
    update.trees.push_back({id, update.base, {}, {}, {broken}});
  }
  ASSERT_TRUE(forest.apply(update)) << forest.why();
  kept.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(differences(kept, seen(forest, 0.0)), 0);
  std::vector<forest::Tree> grown;
  for (std::uint32_t id = 0; id < roots.size(); ++id) grown.push_back(forest.grow(id));
  int lost = 0;
  for (std::uint64_t i = 0; i < RAYS; ++i) {
    const Hit was = castAt(before, i), is = castAt(kept, i);
    const auto is_gone = [&](const Hit& hit) {
      return (hit.label == Label::BRANCH || hit.label == Label::LEAF) &&
             grown[hit.plant].skeleton.branches[static_cast<std::size_t>(hit.branch)].broken;
    };
    EXPECT_FALSE(is_gone(is)) << i;
    if (is_gone(was))
      ++lost;
    else
      EXPECT_TRUE(same(was, is)) << i;
  }
  EXPECT_GT(lost, RAYS / 300);
}

// Makes tree 1 lose branches in this order. @param motion sets their first motion.
void lose(forest::ForestReplica& forest, const std::vector<int>& branches,
          const std::function<void(forest::BrokenBranch&)>& motion = {}) {
  const forest::Tree tree = growTree(forest.layout(), 1, forest.terrain());
  forest::StateUpdate update;
  update.stamp = START;
  update.layout_hash = forest.layoutHash();
  update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
  forest::BrokenBranches broken;
  for (const int branch : branches) {
    forest::BrokenBranch record;
    record.branch = branch;
    record.stamp = START;
    record.pose = tree.skeleton.branches[static_cast<std::size_t>(branch)].rest;
    record.pose.position = Vec3(tree.foot + record.pose.position);
    if (motion) motion(record);
    broken.push_back(record);
  }
  update.trees.push_back({1, update.base, {}, {}, broken});
  ASSERT_TRUE(forest.apply(update)) << forest.why();
}

// The piece is met on the ground below, as a plant whose number follows those of the trees.
TEST(Trees, PiecesAreMetWhereTheyLie) {
  forest::ForestReplica forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  lose(forest, {forest.grow(1).skeleton.depth_end[0]});
  Trees trees = seen(forest, 0.0);
  ASSERT_EQ(trees.all().size(), 5u);
  const auto piece = trees.all().back();
  EXPECT_EQ(piece->id(), 4u);
  const std::vector<forest::Branch> gone = forest.grow(1).skeleton.branches;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i].broken) continue;
    EXPECT_EQ(piece->branchOf(lost), static_cast<int>(i));
    EXPECT_EQ(piece->partOf(static_cast<int>(i)), lost++);
  }
  EXPECT_EQ(piece->parts(), lost);  // no more than it has lost, of which the tree has the rest
  const auto lowest = [&] {
    double out = 1e9;
    for (const PosedBranch& branch : piece->branches())
      out = std::min(out, Vec3(branch.rod.base + branch.rod.length * branch.rod.axis).z());
    return out;
  };
  const double above = lowest();
  trees.update(forest, SENSOR, 60.0, START + fromSeconds(10.0));
  ASSERT_EQ(trees.all().back(), piece);
  EXPECT_LT(lowest(), above - 0.5);
  EXPECT_NEAR(lowest(), 0.0, 1e-3);
  const Rod& rod = piece->branches().front().rod;
  const Vec3 middle = rod.base + 0.5 * rod.length * rod.axis;
  Hit hit;
  trees.meet(Ray(Vec3(middle + Vec3(0.0, 0.0, 0.2)), Vec3(0.0, 0.0, -1.0)), hit);
  EXPECT_EQ(hit.plant, 4u);
  EXPECT_TRUE(gone[static_cast<std::size_t>(hit.branch)].broken);
}

// A piece without room is not grown again at each update, nor is any piece if there is no room.
TEST(Trees, PiecesBeyondTheBudgetAreGrownOnce) {
  forest::ForestReplica forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  const int limb = forest.grow(1).skeleton.depth_end[0];
  lose(forest, {limb});
  const std::size_t trees = seen(forest, 0.0).branches() - seen(forest, 0.0).all().back()->parts();
  Trees few(trees + 1);
  few.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(few.all().size(), 4u);
  EXPECT_EQ(few.leftOut(), 1u);
  const std::uint64_t grown = few.grown();
  EXPECT_EQ(grown, 5u);
  for (int i = 1; i < 4; ++i) few.update(forest, SENSOR, 60.0, START + fromSeconds(0.1 * i));
  EXPECT_EQ(few.grown(), grown);
  EXPECT_EQ(few.leftOut(), 1u);
  Trees full(trees);
  full.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(full.grown(), 4u);
  EXPECT_EQ(full.leftOut(), 1u);
}

// A burst of pieces is grown in the course of several updates, each as long as trees would take.
TEST(Trees, ManyPiecesAppearOneAfterTheOther) {
  forest::ForestReplica forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  const forest::Skeleton whole = forest.grow(1).skeleton;
  std::vector<int> twigs;
  const int last = static_cast<int>(whole.branches.size()) - 1;
  for (int i = 0; i < 40; ++i) twigs.push_back(last - i);
  const std::size_t limit = seen(forest, 0.0).branches() + 100;
  lose(forest, twigs);
  ASSERT_GT(whole.branches.size() * twigs.size(), 2 * limit);
  Trees trees(limit);
  trees.update(forest, SENSOR, 60.0, START);
  EXPECT_GT(trees.all().size(), 4u);
  EXPECT_GT(trees.leftOut(), 0u);
  EXPECT_EQ(trees.all().size() + trees.leftOut(), 44u);
  EXPECT_LE((trees.grown() - 5) * whole.branches.size(), limit);
  for (int i = 0; i < 40; ++i) trees.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(trees.all().size(), 44u);
  EXPECT_EQ(trees.leftOut(), 0u);
  EXPECT_EQ(trees.grown(), 44u);
}

// A piece counts where it is, not where it came off: one that has flown out of reach is left out,
// and cannot spoil the bounds of the others.
TEST(Trees, PiecesAreMetInReachOnly) {
  forest::ForestReplica forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  lose(forest, {forest.grow(1).skeleton.depth_end[0]},
       [](forest::BrokenBranch& record) { record.velocity = Vec3(190.0, 0.0, 20.0); });
  Trees trees;
  trees.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(trees.all().size(), 5u);
  for (const double after : {1.0, 9.0}) {
    trees.update(forest, SENSOR, 60.0, START + fromSeconds(after));
    EXPECT_EQ(trees.all().size(), 4u) << after;
    EXPECT_EQ(trees.leftOut(), 0u) << after;
  }
  trees.update(forest, Vec3(SENSOR + Vec3(190.0 * 4.0, 0.0, 0.0)), 250.0, START + fromSeconds(9.0));
  ASSERT_EQ(trees.all().size(), 1u);
  EXPECT_EQ(trees.all().front()->id(), 4u);
}

// A sensor that sways across the border of a cell moves the origin once.
TEST(Trees, AreNotFittedAnewForASensorThatSways) {
  const auto forest = movingForest(forest::gridLayout(2, 9.0), wind::Field());
  Trees trees;
  trees.update(forest, Vec3(5.9, 0.0, 1.0), 60.0, START);
  EXPECT_EQ(trees.origin(), Vec3(0.0, 0.0, 0.0));
  bool crossed = false;
  for (const double x : {4.1, 3.9, 6.1, 5.9, 3.9, 4.1, 2.1, 6.1, 9.9}) {
    trees.update(forest, Vec3(x, 0.0, 1.0), 60.0, START);
    crossed = crossed || x > 6.0;
    EXPECT_EQ(trees.origin(), Vec3(crossed ? 8.0 : 0.0, 0.0, 0.0)) << x;
  }
  trees.update(forest, Vec3(1.0, 0.0, 1.0), 60.0, START);
  EXPECT_EQ(trees.origin(), Vec3(0.0, 0.0, 0.0));
}

TEST(Trees, AreTheSameForAnyNumberOfThreads) {
  const auto forest = movingForest(forest::gridLayout(3, 7.0), breezeOf(Vec3(6, 2, 0)));
  ThreadPool threads(3);
  Trees together;
  together.update(forest, SENSOR, 60.0, START + fromSeconds(3.0), threads);
  EXPECT_EQ(differences(together, seen(forest, 3.0)), 0);
}

TEST(Trees, AreNotMetWhereThereAreNone) {
  Trees none;
  EXPECT_EQ(castAt(none, 1).label, Label::NONE);
  none.update(movingForest(forest::gridLayout(1, 7.0), wind::Field()), Vec3(900, 0, 0), 10.0,
              START);
  EXPECT_EQ(none.all().size(), 0u);
  EXPECT_EQ(castAt(none, 1).label, Label::NONE);
}

// A turbid body lets through what its depth says: leaves alone, over many trees and rays.
TEST(Trees, LeavesHideWhatIsBehindThemMoreTheMoreThereAre) {
  forest::Layout bare = forest::gridLayout(3, 7.0), full = bare;
  for (forest::Species& species : bare.species)
    for (forest::LimbRule& limb : species.limbs) limb.leaves = 0.0;
  const Trees without = seen(movingForest(bare, wind::Field()), 0.0);
  const Trees with = seen(movingForest(full, wind::Field()), 0.0);
  int wood_without = 0, wood_with = 0, leaves = 0;
  for (std::uint64_t i = 0; i < RAYS; ++i) {
    const Label a = castAt(without, i).label, b = castAt(with, i).label;
    wood_without += a == Label::TRUNK || a == Label::BRANCH ? 1 : 0;
    wood_with += b == Label::TRUNK || b == Label::BRANCH ? 1 : 0;
    leaves += b == Label::LEAF ? 1 : 0;
    EXPECT_NE(a, Label::LEAF);
  }
  EXPECT_LT(wood_with, wood_without);
  EXPECT_GT(leaves, RAYS / 20);
}

TEST(Trees, BeyondTheBudgetTheFarthestAreLeftOut) {
  const auto forest = movingForest(forest::gridLayout(4, 7.0), wind::Field());
  Trees few(3000);
  few.update(forest, SENSOR, 60.0, START);
  EXPECT_LE(few.branches(), 3000u);
  EXPECT_EQ(few.all().size() + few.leftOut(), 16u);
  EXPECT_GT(few.leftOut(), 0u);
  double last = 0.0;
  for (const auto& tree : few.all()) {
    EXPECT_GE(length(tree->foot() - SENSOR), last);
    last = length(tree->foot() - SENSOR);
  }
  const std::uint64_t grown = few.grown();
  few.update(forest, SENSOR, 60.0, START + fromSeconds(1.0));
  EXPECT_EQ(few.grown(), grown);  // nor is the first without room grown again
  Trees one(1);                   // at least one
  one.update(forest, SENSOR, 60.0, START);
  EXPECT_EQ(one.all().size(), 1u);
}

}  // namespace
}  // namespace vegetation_sim::scan

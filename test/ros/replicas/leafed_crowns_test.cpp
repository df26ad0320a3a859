// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/leafed_crowns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "package_folder.h"
#include "scenes/canopy/canopy_scene.h"
#include "sensors/plants/crown_field.h"

namespace vegetation_sim {
namespace {

/// One oak with canopy leaves stands in still air.
class LeafedOak : public ::testing::Test {
 protected:
  LeafedOak() {
    forest::Layout trees;
    trees.species = {forest::loadSpecies(PACKAGE_FOLDER "/config/species/oak.yaml")};
    trees.trees.resize(1);
    trees.trees[0].scale = 0.4;
    trees.trees[0].position = Vec3(2.0, 1.0, 0.0);
    forest_.setLayout(trees, std::make_shared<terrain::HeightMap>());
    layout_ = canopy::shrubScene();
    layout_.crowns.resize(1);
    layout_.kinds[0].leaves = 3000;
    crowns_.grow(layout_, forest_);
  }

  /// Returns the state of the forest with one bent branch, as if it were held.
  void bend(int branch, double angle) {
    forest::StateUpdate state;
    state.layout_hash = forest_.layoutHash();
    state.stamp = canopy::tickStamp(1);
    forest::PromotedBranch held;
    held.branch = branch;
    held.q.first = angle;
    state.trees = {{0, {}, {held}}};
    ASSERT_TRUE(forest_.apply(state)) << forest_.why();
  }

  std::vector<canopy::MovedLeaf> leaves(const canopy::Foliage& foliage) const {
    const LeafedCrowns::Crown& crown = crowns_.crowns()[0];
    const std::vector<Pose> wood = crowns_.wood(0, forest_, canopy::tickStamp(1));
    std::vector<canopy::MovedLeaf> out;
    for (const canopy::CrownLeaf& leaf : crown.leaves)
      out.push_back(carry(foliage, leaf, crown.rest[leaf.twig].pose, wood[leaf.twig]));
    return out;
  }

  bool bears(int branch, std::uint32_t twig) const {
    const auto& branches = forest_.grow(0).skeleton.branches;
    for (int i = static_cast<int>(twig); i >= 0; i = branches[static_cast<std::size_t>(i)].parent)
      if (i == branch) return true;
    return false;
  }

  canopy::Layout layout_;
  forest::ForestReplica forest_;
  LeafedCrowns crowns_;
};

// S3-W2: a held branch moves its own leaves and no others.
TEST_F(LeafedOak, MovesLeavesWithTheHeldBranch) {
  canopy::Canopy canopy(layout_);
  const auto& foliage = canopy.foliage();
  const auto before = leaves(foliage);
  const int limb = forest_.grow(0).skeleton.depth_end[0] + 2;
  bend(limb, 0.4);
  const auto after = leaves(foliage);
  const auto& crown = crowns_.crowns()[0].leaves;
  double carried = 0.0;
  int on_limb = 0;
  for (std::size_t i = 0; i < crown.size(); ++i) {
    const double way = length(Vec3(after[i].root - before[i].root));
    EXPECT_NEAR(length(Vec3(after[i].tip - after[i].root)),
                length(Vec3(before[i].tip - before[i].root)), 1e-9);
    if (bears(limb, crown[i].twig)) {
      ++on_limb;
      carried = std::max(carried, way);
    } else {
      EXPECT_LT(way, 1e-9);
    }
  }
  EXPECT_GT(on_limb, 20);
  EXPECT_GT(carried, 0.1);
}

// S3-W2: the layers move leaves around wood at rest. The leaves stay on the wood and keep their
// length.
TEST_F(LeafedOak, HasLeavesThatMoveInLayersOnTheirWood) {
  canopy::Canopy canopy(layout_);
  canopy.setWind(canopy::breezeFrom(Vec3(1.0, 6.0, 0.0)));
  const auto before = leaves(canopy.foliage());
  canopy::run(canopy, 0, 90);
  const auto after = leaves(canopy.foliage());
  double moved = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_LT(length(Vec3(after[i].root - before[i].root)), 1e-12);
    const double size = length(Vec3(before[i].tip - before[i].root));
    EXPECT_NEAR(length(Vec3(after[i].tip - after[i].root)), size, 1e-9);
    moved = std::max(moved, length(Vec3(after[i].tip - before[i].tip)) / size);
  }
  EXPECT_GT(moved, 0.2);
}

// S3-W2, S3-05: a crown is cut into layers also where no plant stands. The state of the canopy does
// not depend on it, even while the viewer moves, so a replay needs no forest.
TEST_F(LeafedOak, IsCutIntoLayersWithoutAnyPlant) {
  layout_.plants.clear();
  canopy::Canopy with(layout_), without(layout_);
  with.setCrowns(crowns_.boxes());
  std::uint64_t first_cuts = 0, cuts = 0;
  for (int tick = 0; tick < 90; ++tick)
    for (canopy::Canopy* canopy : {&with, &without}) {
      canopy->setWind(canopy::breezeFrom(Vec3(1.0, 6.0, 0.0)));
      canopy->setViewer(canopy::CutView{Vec3(-5.0 + 0.02 * tick, 0.0, 1.5), {}});
      canopy->advance(canopy::tickStamp(tick));
      cuts = static_cast<std::uint64_t>(canopy->snapshot().cuts.since);
      if (tick == 0) first_cuts = cuts;
    }
  EXPECT_NE(cuts, first_cuts);
  EXPECT_EQ(with.snapshot().hash(), without.snapshot().hash());
  EXPECT_EQ(without.foliage().layers(), 1);
  const canopy::Foliage& foliage = with.foliage();
  ASSERT_EQ(foliage.layers(), 3);
  std::array<int, 3> leaves{};
  for (const canopy::CrownLeaf& leaf : crowns_.crowns()[0].leaves)
    ++leaves[static_cast<std::size_t>(foliage.layerAt(leaf.leaf.anchor))];
  for (const int count : leaves) EXPECT_GT(count, 100);
  canopy::Replica replica(layout_);
  replica.setCrowns(crowns_.boxes());
  replica.apply(with.update(false));
  EXPECT_EQ(replica.foliage().layers(), 3);
}

TEST_F(LeafedOak, IgnoresCrownsOfUnknownTrees) {
  layout_.crowns[0].first_tree = 7;
  crowns_.grow(layout_, forest_);
  EXPECT_TRUE(crowns_.crowns().empty());
}

// One tree loses a limb: its crown is grown again without it, the others are kept.
TEST_F(LeafedOak, OnlyTheCrownOfABrokenTreeIsGrownAgain) {
  forest::Layout trees = forest_.layout();
  trees.trees.push_back(trees.trees[0]);
  trees.trees[1].position.x() += 9.0;
  trees.trees[1].seed += 1;
  forest_.setLayout(trees, std::make_shared<terrain::HeightMap>());
  layout_.crowns[0].first_tree = 0;
  layout_.crowns[0].trees = 2;
  crowns_.grow(layout_, forest_);
  ASSERT_EQ(crowns_.crowns().size(), 2u);
  const canopy::CrownLeaf* kept = crowns_.crowns()[0].leaves.data();
  const std::size_t before = crowns_.crowns()[1].leaves.size();
  EXPECT_FALSE(crowns_.regrowBroken(layout_, forest_));
  forest::StateUpdate state;
  state.layout_hash = forest_.layoutHash();
  state.stamp = canopy::tickStamp(1);
  forest::BrokenBranch limb;
  limb.branch = forest_.grow(1).skeleton.depth_end[0] + 2;
  state.trees = {{1, {}, {}, {}, {limb}}};
  ASSERT_TRUE(forest_.apply(state)) << forest_.why();
  EXPECT_TRUE(crowns_.regrowBroken(layout_, forest_));
  EXPECT_EQ(crowns_.crowns()[0].leaves.data(), kept);
  EXPECT_LT(crowns_.crowns()[1].leaves.size(), before);
  EXPECT_FALSE(crowns_.regrowBroken(layout_, forest_));
  LeafedCrowns anew;
  anew.grow(layout_, forest_);
  EXPECT_EQ(anew.crowns()[1].leaves.size(), crowns_.crowns()[1].leaves.size());
}

/// Rays that look at the middles of the leaves from a centimetre beside them.
std::vector<scan::Ray> raysAt(const std::vector<canopy::MovedLeaf>& leaves) {
  std::vector<scan::Ray> out;
  for (const canopy::MovedLeaf& leaf : leaves) {
    const Vec3 normal = Vec3(leaf.tip - leaf.root).cross(leaf.side).normalized();
    out.emplace_back(0.5 * (leaf.root + leaf.tip) + 0.01 * normal, -normal);
  }
  return out;
}

// N1: leaves are where they are drawn, those of a held branch too.
TEST_F(LeafedOak, SensorsMeetTheLeavesWhereTheyHaveMovedTo) {
  canopy::Canopy canopy(layout_);
  const auto& foliage = canopy.foliage();
  const LeafedCrowns::Crown& crown = crowns_.crowns()[0];
  const scan::CrownSource source{crown.tree, &crown.leaves, &crown.rest,
                                 [&] { return crowns_.wood(0, forest_, canopy::tickStamp(1)); }};
  scan::Crowns met;
  ThreadPool threads(2);
  const auto count = [&](const std::vector<scan::Ray>& rays) {
    int out = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      scan::Hit hit;
      hit.distance = 0.011;
      met.meet(rays[i], scan::FloatRay(rays[i]), hit);
      if (hit.label == scan::Label::NONE) continue;
      EXPECT_EQ(hit.label, scan::Label::LEAF);
      EXPECT_EQ(hit.plant, 0u);
      out += hit.branch == static_cast<int>(crown.leaves[i].twig);
    }
    return out;
  };
  met.update({source}, 1, foliage, Vec3::Zero(), threads);
  const auto before = raysAt(leaves(foliage));
  const int all = count(before);
  EXPECT_GT(all, static_cast<int>(0.95 * static_cast<double>(before.size())));
  bend(forest_.grow(0).skeleton.depth_end[0] + 2, 0.4);
  met.update({source}, 1, foliage, Vec3::Zero(), threads);
  EXPECT_LT(count(before), all - 20);
  EXPECT_GE(count(raysAt(leaves(foliage))), all - 20);
  scan::Crowns few(100);
  few.update({source, source}, 1, foliage, Vec3::Zero(), threads);
  EXPECT_EQ(few.all().size(), 1u);
  EXPECT_EQ(few.leftOut(), 1u);
}

}  // namespace
}  // namespace vegetation_sim

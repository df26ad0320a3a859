// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/knife.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

Quat turned(const Vec3& axis, double angle) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z()};
}

/// A foot at (10, 0, 0) with upright shoots of 1 m, 0.1 m apart along x from x = 10, which taper
/// from 20 to 4 mm. Each has a twig at its top that rises further by 0.5 m.
class KnifeTest : public ::testing::Test {
 protected:
  static constexpr int SHOOTS = 8;
  KnifeTest() {
    tree_.foot = Vec3(10.0, 0.0, 0.0);
    add(-1, Vec3::Zero(), 0.3, 0.2, 0.2);
    for (int i = 0; i < SHOOTS; ++i) add(0, Vec3(0.1 * i, 0.0, 0.3), 1.0, 0.02, 0.004);
    for (int i = 0; i < SHOOTS; ++i) add(1 + i, Vec3(0.1 * i, 0.0, 1.3), 0.5, 0.004, 0.002);
  }
  void add(int parent, const Vec3& at, double length, double base, double tip) {
    Branch out;
    out.parent = parent;
    out.length = length;
    out.base_radius = base;
    out.tip_radius = tip;
    tree_.skeleton.branches.push_back(out);
    poses_.push_back({at, {}});
  }
  /// Returns a bar of 0.2 m along and 0.4 m across that moves along x from 10 m by `way`.
  static Knife bar(double height, double way) {
    Knife out;
    out.length = 0.2;
    out.width = 0.4;
    out.from.position = Vec3(10.0, 0.0, height);
    out.to.position = Vec3(10.0 + way, 0.0, height);
    return out;
  }
  std::vector<int> cut(const Knife& knife) const { return findCuts(tree_, poses_, {knife}); }

  Tree tree_;
  std::vector<Pose> poses_;
};

TEST_F(KnifeTest, ABarCutsWhatItPasses) {
  EXPECT_EQ(cut(bar(1.0, 0.25)), (std::vector<int>{1, 2, 3, 4}));  // up to x = 0.35 m
  EXPECT_EQ(cut(bar(1.0, 0.0)), (std::vector<int>{1, 2}));
  EXPECT_TRUE(cut(bar(1.85, 0.25)).empty());
}

TEST_F(KnifeTest, ALongStepLeavesNothingOut) {
  Knife knife = bar(1.0, 0.6);
  knife.length = 0.01;
  knife.from.position.x() -= 1.0;
  EXPECT_EQ(cut(knife).size(), 7u);
}

TEST_F(KnifeTest, ABranchGoesWithTheOneThatCarriesIt) {
  Knife knife = bar(1.4, 0.25);  // twigs
  EXPECT_EQ(cut(knife), (std::vector<int>{9, 10, 11, 12}));
  Knife low = bar(1.2, 0.05);  // shoots 1 and 2
  EXPECT_EQ(findCuts(tree_, poses_, {knife, low}), (std::vector<int>{1, 2, 11, 12}));
}

TEST_F(KnifeTest, OnlyThinPartsAreCut) {
  Knife knife = bar(0.8, 0.25);  // where shoots are 12 mm thick in radius
  knife.thickest = 0.0125;
  EXPECT_EQ(cut(knife).size(), 4u);
  knife.thickest = 0.0115;
  EXPECT_TRUE(cut(knife).empty());
  knife.thickest = 0.0;
  EXPECT_TRUE(cut(knife).empty());
}

TEST_F(KnifeTest, TheFootAndWhatHasComeOffStay) {
  Knife knife = bar(0.1, 0.6);
  knife.thickest = 1.0;
  EXPECT_TRUE(cut(knife).empty());
  tree_.skeleton.branches[2].broken = tree_.skeleton.branches[10].broken = true;
  EXPECT_EQ(cut(bar(1.0, 0.25)), (std::vector<int>{1, 3, 4}));
}

TEST_F(KnifeTest, AnUprightBarTrimsASide) {
  // Its y axis is up; it passes beside the shoots, then through them.
  Knife knife = bar(1.2, 0.25);
  knife.from.orientation = knife.to.orientation = turned(Vec3::UnitX(), 0.5 * PI);
  EXPECT_EQ(cut(knife), (std::vector<int>{1, 2, 3, 4}));
  knife.from.position.y() = knife.to.position.y() = 0.05;
  EXPECT_TRUE(cut(knife).empty());
  knife.to.position.y() = 0.0;
  EXPECT_EQ(cut(knife), (std::vector<int>{2, 3, 4}));
}

TEST_F(KnifeTest, ADiscHasRoundEdges) {
  Knife knife = bar(1.0, 0.0);
  knife.length = knife.width;
  knife.from.position.y() = knife.to.position.y() = 0.195;
  EXPECT_EQ(cut(knife).size(), 3u);
  knife.is_disc = true;  // 4 cm half wide there
  EXPECT_EQ(cut(knife).size(), 1u);
}

TEST_F(KnifeTest, ATurnSweepsAnArc) {
  // A bar that reaches 2.1 to 2.3 m from its axis turns by 0.6 rad about (10, -2, 1).
  Knife knife = bar(1.0, 0.0);
  const auto at = [](double angle) {
    const Quat turn = turned(Vec3::UnitZ(), angle);
    return Pose{Vec3(10.0, -2.0, 1.0) + rotate(turn, Vec3(2.1, 0.0, 0.0)), turn};
  };
  knife.width = 0.02;
  knife.from = at(0.5 * PI - 0.3);
  knife.to = at(0.5 * PI + 0.3);
  // The shoot at a distance x is sqrt(4 + x^2) m from the axis, and 2.0 to 2.2 m are swept.
  EXPECT_EQ(cut(knife), (std::vector<int>{1, 2, 3, 4, 5, 6, 7}));  // atan(0.1 i / 2) < 0.3 rad
}

TEST(KnivesInForest, TreesAreFoundAndSorted) {
  Layout layout;
  layout.species.resize(1);
  for (const double x : {0.0, 500.0, 1.0}) {
    TreeSeed seed;
    seed.position = Vec3(x, 0.0, 0.0);
    layout.trees.push_back(seed);
  }
  const terrain::HeightMap flat;
  std::vector<std::uint32_t> grown;
  const TreePoser trees{[&](std::uint32_t id) {
                          grown.push_back(id);
                          return std::make_shared<const Tree>(growTree(layout, id, flat));
                        },
                        [](const Tree& tree, std::uint32_t) {
                          std::vector<Pose> out;
                          for (const Branch& branch : tree.skeleton.branches)
                            out.push_back(branch.rest);
                          return out;
                        }};
  Knife knife;
  knife.width = knife.length = 8.0;
  knife.thickest = 1.0;
  const double height = growTree(layout, 0, flat).skeleton.height;
  knife.from.position = knife.to.position = Vec3(0.5, 0.0, 0.7 * height);
  const auto cuts = findCuts(layout, TreeGrid(layout), flat, {knife}, trees);
  EXPECT_EQ(grown, (std::vector<std::uint32_t>{0, 2}));
  ASSERT_EQ(cuts.size(), 2u);  // trunks without limbs
  EXPECT_EQ(cuts[0].tree, 0u);
  EXPECT_EQ(cuts[1].tree, 2u);
  EXPECT_GT(cuts[0].branch, 0);
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/crop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::canopy {
namespace {

PlantKind maize() {
  PlantKind out;
  out.shape = PlantShape::STALK;
  out.height = 2.4;
  out.radius = 0.6;
  out.leaves = 14;
  out.pieces = 5;
  out.leaf_length = 0.9;
  out.leaf_width = 0.09;
  out.stems = 7;
  return out;
}

Plant plantAt(const Vec3& position) {
  Plant out;
  out.seed = 7;
  out.position = position;
  out.scale = 1.5;
  return out;
}

double topOf(const GrownPlant& grown) {
  double out = 0.0;
  for (const Leaf& leaf : grown.leaves) out = std::max(out, leaf.tip.z());
  return out;
}

TEST(Stalk, HasConnectedLeavesOnTwoSidesWithinItsSize) {
  const PlantKind kind = maize();
  const Plant plant = plantAt(Vec3(3.0, -2.0, 0.5));
  const GrownPlant grown = grow(kind, plant);
  ASSERT_EQ(grown.leaves.size(), leafCount(kind));
  ASSERT_EQ(grown.leaves.size(), 14U * 5U + 7U + 6U);
  ASSERT_EQ(grown.stems.size(), 1U);
  int right = 0;
  for (std::size_t blade = 0; blade < 14; ++blade) {
    for (std::size_t piece = 0; piece < 5; ++piece) {
      const Leaf& leaf = grown.leaves[6 + 5 * blade + piece];
      EXPECT_EQ(leaf.anchor, grown.leaves[0].anchor);
      EXPECT_GE(leaf.tip.z(), 0.5);
      EXPECT_LE(std::hypot(leaf.tip.x() - 3.0, leaf.tip.y() + 2.0), 1.5 * 0.9);
      if (piece == 0) {
        EXPECT_NEAR(leaf.root.x(), 3.0, 1e-12);
        EXPECT_GT(std::fabs(leaf.tip.x() - 3.0), 2.0 * std::fabs(leaf.tip.y() + 2.0));
        right += leaf.tip.x() > 3.0;
      } else {
        EXPECT_LT(length(Vec3(leaf.root - grown.leaves[5 + 5 * blade + piece].tip)), 1e-12);
      }
    }
  }
  EXPECT_EQ(right, 7);
  EXPECT_NEAR(topOf(grown), 0.5 + 1.5 * 2.4, 0.1 * 2.4);
}

TEST(Stalk, IsAPureFunctionOfTheSeed) {
  Plant plant = plantAt(Vec3::Zero());
  const GrownPlant first = grow(maize(), plant);
  EXPECT_EQ(grow(maize(), plant).leaves[20].tip, first.leaves[20].tip);
  plant.seed = 8;
  EXPECT_NE(grow(maize(), plant).leaves[20].tip, first.leaves[20].tip);
}

TEST(Stage, RaisesSizeThicknessAndLeavesOfAKind) {
  EXPECT_EQ(applyStage(maize(), 1.0).height, 2.4);
  PlantKind before = applyStage(maize(), 0.0);
  EXPECT_NEAR(before.height, 0.05 * 2.4, 1e-12);
  EXPECT_EQ(before.leaves, 3);
  for (int i = 1; i <= 10; ++i) {
    const PlantKind now = applyStage(maize(), 0.1 * i);
    EXPECT_GT(topOf(grow(now, {})), topOf(grow(before, {})));
    EXPECT_GT(now.radius, before.radius);
    EXPECT_GT(now.leaf_length, before.leaf_length);
    EXPECT_GT(now.leaf_width, before.leaf_width);
    EXPECT_GE(now.stem_radius, before.stem_radius);
    EXPECT_GE(now.leaves, before.leaves);
    EXPECT_EQ(now.stems, i < 8 ? 0 : 7);
    before = now;
  }
}

TEST(Stage, OfShrubsRaisesTheirLeavesAndATrellisHasNone) {
  PlantKind kind;
  EXPECT_EQ(applyStage(kind, 0.5).leaves, 900);
  EXPECT_EQ(applyStage(kind, 0.5).stems, kind.stems);
  kind.shape = PlantShape::TRELLIS;
  EXPECT_EQ(applyStage(kind, 0.5).height, kind.height);
}

// The end of a span is the beginning of the next one on a plane of the same slope.
TEST(Trellis, JoinsTheNextOneOnASlope) {
  PlantKind kind;
  kind.shape = PlantShape::TRELLIS;
  kind.height = 1.9;
  kind.radius = 5.5;
  kind.stems = 4;
  kind.stem_radius = 0.04;
  kind.slope = 0.1;
  Plant plant;
  plant.yaw = 0.6;
  Plant next = plant;
  next.position = Vec3(5.5 * std::cos(0.6), 5.5 * std::sin(0.6), 0.55);
  const GrownPlant here = grow(kind, plant), there = grow(kind, next);
  ASSERT_EQ(here.rigid.size(), leafCount(kind));
  EXPECT_TRUE(here.leaves.empty());
  ASSERT_EQ(here.stems.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(length(Vec3(here.stems[i].to - there.stems[i].from)), 1e-12);
    EXPECT_LT(length(Vec3(here.rigid[4 + i].tip - there.rigid[i].tip)), 1e-12);
    EXPECT_LE(here.stems[i].from.z(), kind.height);
  }
  double top = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Leaf& face = here.rigid[i];
    const Vec3 axis = i < 4 ? plant.position : next.position;
    // The displays light a face by this normal, which points out of the post.
    EXPECT_GT(dot(cross(Vec3(face.tip - face.root), face.side), Vec3(face.root - axis)), 0.0);
    top = std::max(top, face.tip.z());
  }
  EXPECT_NEAR(top, 1.9 + 0.55, 1e-12);
}

}  // namespace
}  // namespace vegetation_sim::canopy

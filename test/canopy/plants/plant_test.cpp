// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plants/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vegetation_sim::canopy {
namespace {

PlantKind kindOf(PlantShape shape) {
  PlantKind out;
  out.shape = shape;
  out.leaves = 300;
  return out;
}

// S3-30: shrub, crown, grass-like reeds, plants under water.
TEST(Grow, KeepsEachShapeWithinItsSize) {
  for (const PlantShape shape :
       {PlantShape::SHRUB, PlantShape::CROWN, PlantShape::REED, PlantShape::KELP}) {
    const PlantKind kind = kindOf(shape);
    Plant plant;
    plant.seed = 7;
    plant.position = Vec3(3.0, -2.0, 0.5);
    plant.scale = 2.0;
    const GrownPlant grown = grow(kind, plant);
    ASSERT_EQ(grown.leaves.size(), leafCount(kind));
    double top = 0.0;
    for (const Leaf& leaf : grown.leaves) {
      const Vec3 offset = leaf.root - plant.position;
      EXPECT_LE(std::hypot(offset.x(), offset.y()), 2.0 * (kind.radius + 0.3 * kind.height));
      EXPECT_GE(offset.z(), -1e-12);
      EXPECT_LE(offset.z(), 2.0 * kind.height + 1e-9);
      top = std::max(top, leaf.tip.z() - plant.position.z());
    }
    EXPECT_GT(top, 1.6 * kind.height) << static_cast<int>(shape);
    const bool ribbon = shape == PlantShape::REED || shape == PlantShape::KELP;
    EXPECT_EQ(grown.stems.empty(), ribbon);
  }
}

// S3-03: the pieces of a ribbon hang together on one root.
TEST(Grow, HangsThePiecesOfARibbonOnOneRoot) {
  const PlantKind kind = kindOf(PlantShape::KELP);
  const GrownPlant grown = grow(kind, {});
  for (std::size_t i = 1; i < grown.leaves.size(); ++i) {
    if (i % static_cast<std::size_t>(kind.pieces) == 0) continue;
    EXPECT_EQ(grown.leaves[i].anchor, grown.leaves[i - 1].anchor);
    EXPECT_LT(length(grown.leaves[i].root - grown.leaves[i - 1].tip), 1e-12);
  }
}

// S3-W5: dark inside and below, light outside and above.
TEST(Grow, GivesLessLightToLeavesInsideAndBelow) {
  PlantKind kind = kindOf(PlantShape::SHRUB);
  kind.leaves = 4000;
  double inside = 0.0, outside = 0.0, below = 0.0, above = 0.0;
  int in = 0, out = 0, low = 0, high = 0;
  for (const Leaf& leaf : grow(kind, {}).leaves) {
    const Vec3 place((leaf.root.x()) / kind.radius, leaf.root.y() / kind.radius,
                     2.0 * leaf.root.z() / kind.height - 1.0);
    const double light = leaf.light;
    EXPECT_GE(light, 0.05);
    EXPECT_LE(light, 1.0);
    (length(place) < 0.5 ? inside : outside) += light;
    ++(length(place) < 0.5 ? in : out);
    (place.z() < 0.0 ? below : above) += light;
    ++(place.z() < 0.0 ? low : high);
  }
  EXPECT_LT(inside / in, 0.8 * outside / out);
  EXPECT_LT(below / low, 0.9 * above / high);
}

// No two plants of a kind have the same outline.
TEST(Grow, GivesEachPlantAnOutlineOfItsOwn) {
  PlantKind kind = kindOf(PlantShape::SHRUB);
  kind.leaves = 3000;
  std::array<std::array<double, 8>, 2> reach{};
  for (std::size_t seed = 0; seed < 2; ++seed) {
    Plant plant;
    plant.seed = seed;
    for (const Leaf& leaf : grow(kind, plant).leaves) {
      const double turn = std::atan2(leaf.root.y(), leaf.root.x()) / (2.0 * 3.14159265) + 0.5;
      double& most = reach[seed][static_cast<std::size_t>(turn * 8.0) % 8];
      most = std::max(most, std::hypot(leaf.root.x(), leaf.root.y()));
    }
  }
  double difference = 0.0;
  for (std::size_t i = 0; i < 8; ++i)
    difference = std::max(difference, std::fabs(reach[0][i] - reach[1][i]));
  EXPECT_GT(difference, 0.1 * kind.radius);
}

TEST(Grow, IsAFunctionOfTheSeedAndOfEachLeafsNumber) {
  PlantKind kind = kindOf(PlantShape::SHRUB);
  Plant plant;
  plant.seed = 3;
  const GrownPlant first = grow(kind, plant);
  kind.leaves = 600;
  const GrownPlant more = grow(kind, plant);
  for (std::size_t i = 0; i < first.leaves.size(); ++i)
    ASSERT_EQ(first.leaves[i].tip, more.leaves[i].tip);
  plant.seed = 4;
  EXPECT_NE(grow(kind, plant).leaves[0].tip, more.leaves[0].tip);
}

}  // namespace
}  // namespace vegetation_sim::canopy

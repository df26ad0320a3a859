// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::canopy {
namespace {

PlantKind kindOf(Shape shape) {
  PlantKind out;
  out.shape = static_cast<int>(shape);
  out.leaves = 300;
  return out;
}

// S3-30: shrub, crown, grass-like reeds, plants under water.
TEST(Grow, KeepsEachShapeWithinItsSize) {
  for (const Shape shape : {Shape::SHRUB, Shape::CROWN, Shape::REED, Shape::KELP}) {
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
    const bool ribbon = shape == Shape::REED || shape == Shape::KELP;
    EXPECT_EQ(grown.stems.empty(), ribbon);
  }
}

// S3-03: the pieces of a ribbon hang together on one root.
TEST(Grow, HangsThePiecesOfARibbonOnOneRoot) {
  const PlantKind kind = kindOf(Shape::KELP);
  const GrownPlant grown = grow(kind, {});
  for (std::size_t i = 1; i < grown.leaves.size(); ++i) {
    if (i % static_cast<std::size_t>(kind.pieces) == 0) continue;
    EXPECT_EQ(grown.leaves[i].anchor, grown.leaves[i - 1].anchor);
    EXPECT_LT(length(grown.leaves[i].root - grown.leaves[i - 1].tip), 1e-12);
  }
}

TEST(Grow, IsAFunctionOfTheSeedAndOfEachLeafsNumber) {
  PlantKind kind = kindOf(Shape::SHRUB);
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

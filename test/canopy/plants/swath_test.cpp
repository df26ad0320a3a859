// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/swath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double FIELD = 0.5, STUBBLE = 0.3;  // [m]

PlantKind cropKind(PlantShape shape) {
  PlantKind out;
  out.shape = shape;
  out.height = 2.4;
  out.radius = 0.3;
  out.leaves = shape == PlantShape::SHRUB ? 300 : 14;
  out.leaf_length = shape == PlantShape::STALK ? 0.9 : 0.12;
  return out;
}

Plant cropPlant(std::uint64_t seed) {
  Plant out;
  out.seed = seed;
  out.position = Vec3(3.0, -2.0, FIELD);
  return out;
}

double areaOf(const Leaf& leaf) {
  return length(leaf.side) * length(leaf.tip - leaf.root) *
         double{leaf.root_width + leaf.tip_width};
}

/// Leaves that stand and leaves that lie.
struct Sorted {
  std::vector<Leaf> stand, lie;
  double standing_area{0.0}, lying_area{0.0};

  explicit Sorted(const GrownPlant& plant) {
    for (const Leaf& leaf : plant.leaves) {
      (leaf.lies ? lie : stand).push_back(leaf);
      (leaf.lies ? lying_area : standing_area) += areaOf(leaf);
    }
  }
};

const auto SHAPES = {PlantShape::SHRUB, PlantShape::REED, PlantShape::KELP, PlantShape::STALK};

TEST(Swath, WhatIsCutOffLiesOnTheGround) {
  for (const PlantShape shape : SHAPES) {
    const PlantKind kind = cropKind(shape);
    const Plant plant = cropPlant(7);
    const Sorted whole(grow(kind, plant)), cut(grow(kind, plant, STUBBLE));
    EXPECT_TRUE(whole.lie.empty());
    ASSERT_FALSE(cut.lie.empty());
    // Only the rest of the leaves and pieces through which the cut goes is lost.
    EXPECT_EQ(cut.stand.size() + cut.lie.size(), whole.stand.size());
    const double all = cut.standing_area + cut.lying_area;
    EXPECT_LE(all, whole.standing_area * (1.0 + 1e-6));
    EXPECT_GT(all, 0.8 * whole.standing_area);
    for (const Leaf& leaf : cut.lie)
      for (const auto& [end, width] :
           {std::pair{leaf.root, leaf.root_width}, std::pair{leaf.tip, leaf.tip_width}})
        for (const double side : {-1.0, 1.0}) {
          const double z = end.z() + side * double{width} * leaf.side.z();
          EXPECT_GE(z, FIELD);
          EXPECT_LE(z, FIELD + SWATH_HEIGHT);
          EXPECT_LT(length(end - Vec3(3.0, -2.0, FIELD)), 2.4);
        }
  }
}

TEST(Swath, ALowerCutMovesNoStraw) {
  for (const PlantShape shape : SHAPES) {
    const PlantKind kind = cropKind(shape);
    const Sorted high(grow(kind, cropPlant(7), 1.2)), low(grow(kind, cropPlant(7), STUBBLE));
    EXPECT_GT(low.lie.size(), high.lie.size());
    for (const Leaf& leaf : high.lie)
      EXPECT_TRUE(std::any_of(low.lie.begin(), low.lie.end(), [&](const Leaf& other) {
        return other.root == leaf.root && other.tip == leaf.tip;
      }));
  }
}

TEST(Swath, PiecesOfARibbonFollowEachOther) {
  const PlantKind kind = cropKind(PlantShape::REED);
  const Sorted cut(grow(kind, cropPlant(3), 0.0));
  ASSERT_EQ(cut.lie.size(), static_cast<std::size_t>(kind.leaves * kind.pieces));
  for (std::size_t i = 0; i < cut.lie.size(); ++i) {
    const bool is_first = i % static_cast<std::size_t>(kind.pieces) == 0;
    EXPECT_TRUE(is_first || cut.lie[i].root == cut.lie[i - 1].tip) << i;
  }
}

TEST(Swath, PlantsFallInDirectionsOfTheirOwn) {
  const PlantKind kind = cropKind(PlantShape::STALK);
  std::vector<double> angles;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Sorted cut(grow(kind, cropPlant(seed), STUBBLE)),
        same(grow(kind, cropPlant(seed), STUBBLE));
    Vec3 middle = Vec3::Zero();
    for (std::size_t i = 0; i < cut.lie.size(); ++i) {
      middle += 0.5 * (cut.lie[i].root + cut.lie[i].tip) - Vec3(3.0, -2.0, FIELD);
      EXPECT_EQ(cut.lie[i].root, same.lie[i].root);
    }
    angles.push_back(std::atan2(middle.y(), middle.x()));
  }
  for (int quarter = 0; quarter < 4; ++quarter)
    EXPECT_GT(std::count_if(
                  angles.begin(), angles.end(),
                  [&](double angle) { return std::floor((angle + PI) / (0.5 * PI)) == quarter; }),
              3);
}

}  // namespace
}  // namespace vegetation_sim::canopy

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/trees_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

double distanceOf(const Layout& layout, std::uint32_t tree, const Vec3& centre) {
  const Vec3 at = seedOf(layout, tree).position - centre;
  return std::sqrt(at.x() * at.x() + at.y() * at.y());
}

/// Returns a layout of three single trees and two tiles.
Layout mixedLayout() {
  Layout layout;
  layout.species.resize(1);
  for (const double x : {-5.0, 40.0, 3.0}) {
    TreeSeed seed;
    seed.position = Vec3(x, 0.0, 7.0);  // heights do not count
    layout.trees.push_back(seed);
  }
  Tile tile;
  tile.first_tree = 3;
  tile.count = 90;
  tile.seed = 5;
  tile.size = 60.0;
  tile.mix = {1.f};
  layout.tiles.push_back(tile);
  tile.first_tree += tile.count;
  tile.x = -60.0;
  tile.seed = 6;
  layout.tiles.push_back(tile);
  return layout;
}

// The reference compares every tree.
TEST(TreesAround, FindsEveryTreeOfTheDiscAndNoOther) {
  const Layout layout = mixedLayout();
  for (const double radius : {0.0, 4.0, 25.0, 1e6})
    for (const Vec3& centre :
         {Vec3(0.0, 0.0, 0.0), Vec3(31.0, 22.0, -50.0), Vec3(-20.0, 70.0, 0.0)}) {
      std::vector<std::uint32_t> expected, found = treesAround(layout, centre, radius);
      for (std::uint32_t i = 0; i < layout.treeCount(); ++i)
        if (distanceOf(layout, i, centre) <= radius) expected.push_back(i);
      for (std::size_t i = 1; i < found.size(); ++i)
        EXPECT_LE(distanceOf(layout, found[i - 1], centre), distanceOf(layout, found[i], centre));
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << "radius " << radius;
    }
  EXPECT_EQ(treesAround(layout, Vec3::Zero(), 1e6).size(), 183u);
}

TEST(TreesAround, TreesAtEqualDistanceAreInOrderOfTheirIds) {
  Layout layout;
  layout.species.resize(1);
  for (const double x : {2.0, -2.0, 2.0}) {
    TreeSeed seed;
    seed.position = Vec3(x, 0.0, 0.0);
    layout.trees.push_back(seed);
  }
  EXPECT_EQ(treesAround(layout, Vec3::Zero(), 2.0), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace vegetation_sim::forest

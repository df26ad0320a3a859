// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/tree_grid.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

// Trees of very different sizes, on both sides of the origin, some of them on the lines between
// cells.
Layout scattered(int count) {
  Layout out = gridLayout(1, 1.0);
  const Random random(5);
  out.trees.clear();
  for (int i = 0; i < count; ++i) {
    const Random own = random.child(static_cast<std::uint64_t>(i));
    TreeSeed seed;
    seed.species = static_cast<std::uint16_t>(i % 4);
    seed.scale = i % 50 ? own.uniform(0, 0.1, 1.5) : 6.0;
    seed.position = Vec3(own.uniform(1, -400.0, 400.0), own.uniform(2, -400.0, 400.0), 0.0);
    if (i % 7 == 0) seed.position.x() = 16.0 * (i % 20 - 10);
    out.trees.push_back(seed);
  }
  return out;
}

TEST(TreeGrid, FindsTheTreesThatAComparisonWithAllFinds) {
  const Layout layout = scattered(2000);
  const TreeGrid grid(layout);
  const terrain::HeightMap flat;
  const Random random(9);
  std::size_t found = 0, largest = 0;
  for (int i = 0; i < 500; ++i) {
    const Random own = random.child(static_cast<std::uint64_t>(i));
    const Vec3 centre(own.uniform(0, -500.0, 500.0), own.uniform(1, -500.0, 500.0), 2.0);
    const double radius = i % 100 ? own.uniform(2, 0.0, 30.0) : 1e5;
    const auto all = findTreesNear(layout, flat, centre, radius);
    ASSERT_EQ(findTreesNear(layout, &grid, flat, centre, radius), all) << i;
    found += all.size();
    largest = std::max(largest, all.size());
  }
  EXPECT_GT(found, 10000u);
  EXPECT_EQ(largest, layout.trees.size());
}

TEST(TreeGrid, ReturnsFewCandidates) {
  const TreeGrid grid(gridLayout(100, 10.0));
  const auto near = grid.findCandidates(Vec3(500.0, 500.0, 0.0), 1.0);
  EXPECT_GT(near.size(), 4u);
  EXPECT_LT(near.size(), 200u);  // of 10 000
  EXPECT_TRUE(TreeGrid().findCandidates(Vec3::Zero(), 1.0).empty());
}

}  // namespace
}  // namespace vegetation_sim::forest

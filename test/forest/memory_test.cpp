// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What a million trees take, counted at the allocator.
#include <gtest/gtest.h>

#include "forest/forest_fixture.h"
#include "heap.h"

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr long MOST_PER_TREE = 200;  // [byte] that stay, of each of a million trees
constexpr long TREES = 1000000;

Layout millionTrees() {
  Layout out = gridLayout(1, 1.0);
  out.trees.clear();
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Tile tile;
    tile.first_tree = i * 1000;
    tile.count = 1000;
    tile.seed = i;
    tile.x = 200.0 * (i % 32);
    tile.y = 200.0 * (i / 32);
    tile.size = 200.0;
    tile.mix = {1.f, 1.f, 1.f, 1.f};
    out.tiles.push_back(tile);
  }
  return out;
}

// A million trees as a law: nothing per tree while nobody looks; not too much even if every one of
// them is held at a level of its own.
TEST(Memory, MillionTreesStayWithinTheirBytes) {
  const long before = liveBytes();
  Settings settings;
  settings.budget.frame_time = 1e6;  // no tree is held back
  Forest forest(millionTrees(), flatTerrain(), settings);
  ASSERT_EQ(forest.layout().treeCount(), static_cast<std::uint32_t>(TREES));
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  forest.advance(START);
  const long unwatched = liveBytes() - before;
  EXPECT_LT(unwatched, TREES);  // less than a byte each
  Viewer eye;
  eye.id = "eye";
  eye.eye.position = Vec3(3000, 3000, 100);
  eye.eye.pixels_per_radian = 1e6;  // sees every twig of the farthest tree
  eye.stamp = START;
  forest.setViewer(eye);
  forest.advance(START + NANOSECONDS_PER_SECOND / 30);
  ASSERT_EQ(forest.memory().levels.held().size(), static_cast<std::size_t>(TREES));
  forest.update(false);
  const long watched = liveBytes() - before;
  EXPECT_GT(watched, 40 * TREES);  // else nothing was counted
  EXPECT_LT(watched, MOST_PER_TREE * TREES);
  RecordProperty("bytes_unwatched", std::to_string(unwatched));
  std::printf("a million trees: %ld bytes unwatched, %.1f bytes a tree with all of them held\n",
              unwatched, static_cast<double>(watched) / TREES);
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/shards/tree_owners.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

// Trees outside tiles, then `side` x `side` tiles of 10 m with 9 trees each.
Layout tiledLayout(int trees_side, int side) {
  Layout out = gridLayout(trees_side, 3.0);
  std::uint32_t next = out.treeCount();
  for (int i = 0; i < side * side; ++i) {
    Tile tile;
    tile.first_tree = next;
    tile.count = 9;
    tile.seed = static_cast<std::uint64_t>(i) + 7;
    tile.x = 20.0 + 10.0 * (i % side);
    tile.y = 10.0 * (i / side);
    tile.mix.assign(4, 1.f);
    next += tile.count;
    out.tiles.push_back(tile);
  }
  return out;
}

std::string faultOf(std::uint32_t index, std::uint32_t count) {
  return errorOf([&] { TreeOwners(gridLayout(2, 5.0), {index, count}); });
}

TEST(TreeOwners, EachTreeHasOneOwnerAndSharesAreEqual) {
  const Layout layout = tiledLayout(7, 6);
  for (const std::uint32_t count : {1u, 2u, 3u, 4u, 8u}) {
    std::uint32_t sum = 0;
    for (std::uint32_t index = 0; index < count; ++index) {
      const TreeOwners owners(layout, {index, count});
      std::uint32_t owned = 0;
      for (std::uint32_t tree = 0; tree < layout.treeCount(); ++tree) {
        ASSERT_LT(owners.ownerOf(tree), count);
        ASSERT_EQ(owners.owns(tree), owners.ownerOf(tree) == index);
        owned += owners.owns(tree);
      }
      EXPECT_EQ(owners.countOwned(), owned);
      EXPECT_NEAR(owned, layout.treeCount() / count, 9.0) << index << " of " << count;
      sum += owned;
    }
    EXPECT_EQ(sum, layout.treeCount()) << count;
  }
}

// The trees of a tile have one owner, so that a tile is visited by one shard.
TEST(TreeOwners, ATileIsNotDivided) {
  const Layout layout = tiledLayout(3, 5);
  const TreeOwners owners(layout, {0, 4});
  for (const Tile& tile : layout.tiles)
    for (std::uint32_t i = 1; i < tile.count; ++i)
      EXPECT_EQ(owners.ownerOf(tile.first_tree + i), owners.ownerOf(tile.first_tree));
}

// A shard is a region: of 16 x 16 trees, each of four has one quarter of the square.
TEST(TreeOwners, AShardIsARegion) {
  Layout layout = gridLayout(16, 4.0);  // cells of the curve are 1 m
  for (TreeSeed& seed : layout.trees) seed.position -= Vec3(32.0, 32.0, 0.0);
  const TreeOwners owners(layout, {0, 4});
  std::map<std::pair<bool, bool>, std::set<std::uint32_t>> found;
  for (std::uint32_t tree = 0; tree < layout.treeCount(); ++tree) {
    const Vec3& at = layout.trees[tree].position;
    found[{at.x() < 0.0, at.y() < 0.0}].insert(owners.ownerOf(tree));
  }
  for (const auto& quarter : found) EXPECT_EQ(quarter.second.size(), 1u);
}

TEST(TreeOwners, RejectsAShardByNameValueAndRange) {
  EXPECT_EQ(faultOf(0, 0), "shard: count = 0 is outside 1 to 256");
  EXPECT_EQ(faultOf(0, 257), "shard: count = 257 is outside 1 to 256");
  EXPECT_EQ(faultOf(2, 2), "shard: index = 2 is outside 0 to 1, because count = 2");
  EXPECT_EQ(faultOf(255, 256), "");
}

TEST(TreeOwners, NamesTheOwnerOfATreeThatIsNotOwned) {
  const Layout layout = gridLayout(2, 50.0);
  const TreeOwners owners(layout, {1, 2});
  EXPECT_EQ(errorOf([&] { owners.requireOwned("grab", 0); }),
            "grab: tree = 0 belongs to shard 0 of 2, this is shard 1");
  EXPECT_EQ(errorOf([&] { owners.requireOwned("grab", 3); }), "");
}

TEST(TreeOwners, ALayoutWithoutTreesHasNoOwners) {
  Layout layout = gridLayout(1, 1.0);
  layout.trees.clear();
  EXPECT_EQ(TreeOwners(layout, {3, 8}).countOwned(), 0u);
}

}  // namespace
}  // namespace vegetation_sim::forest

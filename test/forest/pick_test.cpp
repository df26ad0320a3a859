// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/pick.h"

#include <gtest/gtest.h>

#include "forest/tree_cache.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

PosedTree atRest(const Layout& layout, std::uint32_t id) {
  const auto tree = std::make_shared<const Tree>(growTree(layout, id, terrain::HeightMap()));
  return {tree, poseBranches(*tree, wind::Instant(), Weights{})};
}

// S1-02: a ray aimed at any branch of any tree meets it, or one in front of it.
TEST(Pick, RayMeetsTheBranchItIsAimedAt) {
  const Layout layout = gridLayout(3, 12.0);
  const Random random(4);
  int exact = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto id = static_cast<std::uint32_t>(random.bits(3 * i) % 9);
    const PosedTree posed = atRest(layout, id);
    const std::size_t b = random.bits(3 * i + 1) % posed.poses.size();
    const Vec3 target =
        posed.tree->foot +
        0.5 * (posed.poses[b].position + tipOf(posed.tree->skeleton.branches[b], posed.poses[b]));
    Ray ray;
    ray.origin = Vec3(-20.0, 10.0 * random.uniform(3 * i + 2), 30.0);
    ray.direction = target - ray.origin;
    const auto hit = pickTree(layout, terrain::HeightMap(), ray,
                              [&](std::uint32_t tree) { return atRest(layout, tree); });
    ASSERT_TRUE(hit);
    EXPECT_LE(hit->distance, length(ray.direction) + 1e-6);
    if (hit->tree == id && hit->branch == static_cast<int>(b)) {
      EXPECT_NEAR(length(hit->point - target), 0.0, 0.2);
      ++exact;
    }
  }
  EXPECT_GT(exact, 30);  // the others are hidden by branches in front
}

TEST(Pick, RayAtTheSkyMeetsNothing) {
  const Layout layout = gridLayout(2, 12.0);
  Ray ray;
  ray.origin = Vec3(5, 5, 40);
  ray.direction = Vec3(0.1, 0, 1);
  EXPECT_FALSE(pickTree(layout, terrain::HeightMap(), ray,
                        [&](std::uint32_t tree) { return atRest(layout, tree); }));
}

TEST(Pick, TreesInTilesAreFound) {
  Layout layout = gridLayout(1, 1.0);
  layout.trees.clear();
  Tile tile;
  tile.count = 25;
  tile.size = 60.0;
  tile.mix = {1.f, 1.f, 1.f, 1.f};
  layout.tiles = {tile};
  const PosedTree posed = atRest(layout, 12);
  Ray ray;
  ray.origin = posed.tree->foot + Vec3(-3.0, 0.0, 0.2);
  ray.direction = Vec3(1.0, 0.0, 0.0);
  const auto hit = pickTree(layout, terrain::HeightMap(), ray,
                            [&](std::uint32_t tree) { return atRest(layout, tree); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->tree, 12u);
  EXPECT_EQ(hit->branch, 0);
}

TEST(Pick, TreesBehindTheHitAreNotGrown) {
  Layout layout = gridLayout(12, 6.0);
  Ray ray;
  ray.origin = Vec3(-30.0, 0.0, 0.3);
  ray.direction = Vec3(1.0, 0.0, 0.0);
  int grown = 0;
  const auto hit = pickTree(layout, terrain::HeightMap(), ray, [&](std::uint32_t tree) {
    ++grown;
    return atRest(layout, tree);
  });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->tree, 0u);
  EXPECT_LT(grown, 100);  // of 144
}

// One request must not grow a whole forest.
TEST(Pick, RayThatPassesTooManyTreesIsRejected) {
  Layout layout = gridLayout(1, 1.0);
  const PosedTree away = [&] {
    auto tree = std::make_shared<Tree>(growTree(layout, 0, terrain::HeightMap()));
    tree->foot.z() += 1000.0;
    return PosedTree{tree, poseBranches(*tree, wind::Instant(), Weights{})};
  }();
  layout.trees.clear();
  Tile tile;
  tile.count = 100000;
  tile.size = 20.0;
  tile.mix = {1.f, 1.f, 1.f, 1.f};
  layout.tiles = {tile};
  Ray ray;
  ray.origin = Vec3(-30.0, 10.0, 0.3);
  ray.direction = Vec3(1.0, 0.0, 0.0);
  std::size_t grown = 0;
  EXPECT_THROW(pickTree(layout, terrain::HeightMap(), ray,
                        [&](std::uint32_t) {
                          ++grown;
                          return away;
                        }),
               InvalidInput);
  EXPECT_LE(grown * away.poses.size(), 1000000u + 2 * away.poses.size());
}

// S1-04, S1-25: grown trees are dropped when others need the room.
TEST(TreeCache, HoldsNoMoreThanItsCapacity) {
  const Layout layout = gridLayout(4, 10.0);
  TreeCache cache(2000);
  const terrain::HeightMap flat;
  const auto first = cache.get(layout, flat, 0);
  for (std::uint32_t id = 0; id < 16; ++id) {
    cache.get(layout, flat, id);
    EXPECT_LE(cache.branches(), 2000u);
  }
  EXPECT_EQ(cache.get(layout, flat, 0)->tree.skeleton.hash(), first->tree.skeleton.hash());
  EXPECT_THROW(cache.get(layout, flat, 99), std::out_of_range);
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/tree_regions.h"

#include <gtest/gtest.h>

#include <set>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::uint32_t COUNT = 20000;
constexpr double SIDE = 2000.0;  // [m]

std::vector<TreeRegions::Region> scatter() {
  const Random random(3);
  std::vector<TreeRegions::Region> out;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < COUNT; ++i) {
    const bool tile = i % 50 == 0;
    const Vec3 at(random.uniform(3 * i, 0.0, SIDE), random.uniform(3 * i + 1, 0.0, SIDE),
                  random.uniform(3 * i + 2, -5.0, 5.0));
    out.push_back({{at, tile ? 30.0 : 8.0}, first, tile ? 20u : 1u});
    first += out.back().count;
  }
  return out;
}

bool touches(const Ball& ball, const Vec3& place, double range) {
  return length(ball.centre - place) - ball.reach < range;
}

// What is near is visited once, what is far is passed over together.
TEST(TreeRegions, NearRegionsAreVisitedAndFarOnesPassedOverTogether) {
  const std::vector<TreeRegions::Region> all = scatter();
  const TreeRegions regions(all);
  for (const Vec3& place : {Vec3(700, 900, 2), Vec3(0, 0, 0), Vec3(-400, 1000, 0)}) {
    std::set<std::uint32_t> visited;
    int tests = 0;
    regions.visit(
        [&](const Ball& ball) {
          ++tests;
          return touches(ball, place, 60.0);
        },
        [&](const TreeRegions::Region& region) {
          EXPECT_TRUE(visited.insert(region.first).second) << region.first;
        });
    std::size_t near = 0;
    for (const TreeRegions::Region& region : all) {
      if (!touches(region.ball, place, 60.0)) continue;
      ++near;
      EXPECT_TRUE(visited.count(region.first)) << region.first;
    }
    EXPECT_LE(visited.size(), 3 * near + 8);
    EXPECT_LE(tests, static_cast<int>(COUNT / 20)) << "of " << COUNT;
  }
}

TEST(TreeRegions, AFewOrNoneAreVisitedToo) {
  const auto all = [](const Ball&) { return true; };
  for (const std::size_t count : {0u, 1u, 8u, 9u, 65u}) {
    std::vector<TreeRegions::Region> some = scatter();
    some.resize(count);
    std::size_t visited = 0;
    TreeRegions(some).visit(all, [&](const TreeRegions::Region&) { ++visited; });
    EXPECT_EQ(visited, count);
  }
  TreeRegions().visit(all, [](const TreeRegions::Region&) { FAIL(); });
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/moving_shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::view {
namespace {

const Vec3 TO_SUN = Vec3(-0.5, -0.4, 0.7).normalized();

/// Trees in a gust, all of which move with all their depths.
struct Gust {
  explicit Gust(int side) {
    forest::Layout layout = forest::gridLayout(side, 9.0);
    const std::uint64_t hash = layout.hash();
    const wind::Field wind({forest::makeBreeze(1, Vec3(25.0, 5.0, 0.0))}, 3);
    replica.setLayout(std::move(layout), forest::flatTerrain());
    replica.setWind(wind);
    forest::StateUpdate update;
    update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
    update.layout_hash = hash;
    update.wind_hash = wind.hash();
    EXPECT_TRUE(replica.apply(update));
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < replica.layout().treeCount(); ++i) ids.push_back(i);
    trees = std::make_unique<TreeSet>(replica, ids);
    while (!trees->grow(replica, TO_SUN, true, 1.0)) continue;
  }
  MovingShadows shadows() const { return {*trees, replica.terrain(), TO_SUN}; }
  std::vector<float> lightAt(double time) const {
    MovingShadows out = shadows();
    out.follow(Vec3::Zero());
    EXPECT_TRUE(out.paint(replica, fromSeconds(time), 1e9));
    return out.light();
  }

  forest::ForestReplica replica;
  std::unique_ptr<TreeSet> trees;
};

double meanDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::fabs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  return sum / static_cast<double>(a.size());
}

// Moving shadows: two instants of a gust differ, and each is the shadow of the posed trees.
TEST(MovingShadows, FollowTheTreesInAGust) {
  const Gust gust(2);
  const std::vector<float> first = gust.lightAt(2.0), second = gust.lightAt(4.0);
  EXPECT_EQ(first, gust.lightAt(2.0));
  const double moved = meanDifference(first, second);
  const MovingShadows still = gust.shadows();
  const double dark = meanDifference(still.light(), std::vector<float>(first.size(), 1.f));
  std::printf("mean change of light in 2 s %.4f, from rest %.4f, mean shadow %.4f\n", moved,
              meanDifference(first, still.light()), dark);
  EXPECT_GT(moved, 0.02 * dark);
  const std::vector<float> direct =
      castShadows(still.plot(), still.edge(), wholePlot(still.edge()), gust.replica.terrain(),
                  TO_SUN, [&](const ShadowDrop& drop) {
                    for (const auto& tree : gust.trees->trees())
                      dropTree(*tree, gust.replica.pose(tree->tree(), tree->id(), fromSeconds(2.0)),
                               true, 1.0, drop);
                  });
  EXPECT_LT(meanDifference(first, direct), 1e-5);
}

// Work of one call ends in time; all calls together paint what one long call paints.
TEST(MovingShadows, AreTheSameInSlices) {
  const Gust gust(3);
  MovingShadows sliced = gust.shadows();
  sliced.follow(Vec3::Zero());
  int calls = 1;
  while (!sliced.paint(gust.replica, fromSeconds(2.0), 0.0)) ++calls;
  EXPECT_EQ(calls, static_cast<int>(sliced.movingTrees()));
  EXPECT_EQ(sliced.light(), gust.lightAt(2.0));
  EXPECT_FALSE(sliced.paint(gust.replica, fromSeconds(2.0), 1.0));  // nothing has changed
  EXPECT_TRUE(sliced.paint(gust.replica, fromSeconds(2.1), 1.0));
}

// Only so many trees move as fit; a change of the viewer's place changes which.
TEST(MovingShadows, FarTreesRest) {
  const Gust gust(8);
  MovingShadows shadows = gust.shadows();
  const std::vector<float> still = shadows.light();
  shadows.follow(Vec3::Zero());
  EXPECT_LT(shadows.movingTrees(), gust.trees->trees().size());
  ASSERT_TRUE(shadows.paint(gust.replica, fromSeconds(2.0), 1e9));
  shadows.takeChanged();
  std::vector<float> near = shadows.light();
  const Plot plot = shadows.plot();
  const auto columnOf = [&](double x) {
    return static_cast<std::size_t>((x - plot.x) / plot.edge * shadows.edge());
  };
  const auto width = static_cast<std::size_t>(shadows.edge());
  const auto changeIn = [&](const std::vector<float>& light, double from, double to) {
    double sum = 0.0;
    for (std::size_t row = columnOf(from); row < columnOf(to); ++row)
      for (std::size_t column = columnOf(from); column < columnOf(to); ++column)
        sum += std::fabs(static_cast<double>(light[row * width + column]) -
                         static_cast<double>(still[row * width + column]));
    return sum;
  };
  EXPECT_GT(changeIn(near, -5.0, 8.0), 1.0);
  EXPECT_LT(changeIn(near, 60.0, 73.0), 1e-3);
  shadows.follow(Vec3(63.0, 63.0, 2.0));
  ASSERT_TRUE(shadows.paint(gust.replica, fromSeconds(2.0), 1e9));
  EXPECT_LT(changeIn(shadows.light(), -5.0, 8.0), 1e-1);  // they rest again
  EXPECT_GT(changeIn(shadows.light(), 60.0, 73.0), 1.0);
  const Window changed = shadows.takeChanged();  // both places
  EXPECT_GT(changed.columns, shadows.edge() / 2);
}

}  // namespace
}  // namespace vegetation_sim::view

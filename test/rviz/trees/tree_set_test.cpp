// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/tree_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rviz/ground/ground_texture.h"
#include "rviz/ground/shadow_painter.h"
#include "rviz/textures/grain_texture.h"
#include "rviz/trees/limb_ends.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::view {
namespace {

using forest::ForestReplica;
using forest::Layout;

const Vec3 FROM_SOUTH_WEST(-0.5, -0.5, 0.7);

Layout tiledLayout() {
  Layout out = forest::gridLayout(2, 10.0);
  for (int i = 0; i < 25; ++i) {
    forest::Tile tile;
    tile.first_tree = out.treeCount();
    tile.count = 40;
    tile.seed = static_cast<std::uint64_t>(i);
    tile.x = 50.0 * (i % 5);
    tile.y = 50.0 * (i / 5);
    tile.size = 50.0;
    tile.mix = {1.f, 1.f, 1.f, 1.f};
    out.tiles.push_back(tile);
  }
  return out;
}

ForestReplica replicaOf(const Layout& layout) {
  ForestReplica out;
  out.setLayout(layout, forest::flatTerrain());
  return out;
}

TreeSet grown(const ForestReplica& replica, std::vector<std::uint32_t> ids, bool leaves = true) {
  TreeSet out(replica, std::move(ids));
  while (!out.grow(replica, FROM_SOUTH_WEST, leaves, 1.0)) continue;
  return out;
}

TEST(NearestTrees, AreAllTreesOfASmallForest) {
  const Layout layout = forest::gridLayout(3, 5.0);
  EXPECT_EQ(nearestTrees(layout, Vec3::Zero(), 9).size(), 9u);
  EXPECT_EQ(nearestTrees(layout, Vec3::Zero(), 100).size(), 9u);
}

// Returns many trees in one tile and few in tiles of other sizes.
Layout unevenLayout() {
  Layout out = tiledLayout();
  const std::pair<std::uint32_t, double> tiles[] = {{5000, 90.0}, {3, 300.0}, {700, 40.0}};
  for (const auto& [count, size] : tiles) {
    forest::Tile tile = out.tiles.back();
    tile.first_tree = out.treeCount();
    tile.count = count;
    tile.size = size;
    tile.x -= 70.0;
    out.tiles.push_back(tile);
  }
  return out;
}

// Compares with a search through all trees.
void expectNearest(const Layout& layout) {
  for (const Vec3& viewer :
       {Vec3(0, 0, 2), Vec3(120, 130, 2), Vec3(190, 210, 2), Vec3(400, -50, 30)}) {
    for (const std::size_t most : {1u, 7u, 100u, 600u}) {
      std::vector<std::pair<double, std::uint32_t>> all;
      for (std::uint32_t i = 0; i < layout.treeCount(); ++i) {
        const Vec3 at = forest::seedOf(layout, i).position - viewer;
        all.emplace_back(std::hypot(at.x(), at.y()), i);
      }
      std::sort(all.begin(), all.end());
      std::vector<std::uint32_t> expected;
      for (std::size_t i = 0; i < most; ++i) expected.push_back(all[i].second);
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(nearestTrees(layout, viewer, most), expected) << most;
    }
  }
}

TEST(NearestTrees, AreTheNearestOfTiles) {
  expectNearest(tiledLayout());
  expectNearest(unevenLayout());
}

// The search reads only the trees of a tile that are near enough.
TEST(NearestTrees, AreFoundFastInATileOfMillions) {
  Layout layout = tiledLayout();
  layout.trees.clear();
  layout.tiles.resize(1);
  layout.tiles[0].first_tree = 0;
  layout.tiles[0].count = forest::MOST_TREES;
  layout.tiles[0].size = 40000.0;
  const Vec3 viewer(23456.0, 12345.0, 2.0);
  const auto near = nearestTrees(layout, viewer, 100);
  ASSERT_EQ(near.size(), 100u);
  double farthest = 0.0;
  for (const std::uint32_t id : near)
    farthest =
        std::max(farthest, length(forest::seedOf(layout, id).position + Vec3(0, 0, 2) - viewer));
  const double mean = std::sqrt(100.0 * 40000.0 * 40000.0 / forest::MOST_TREES / M_PI);
  EXPECT_NEAR(farthest, mean, 0.1 * mean);  // mean is the radius of the disc that 100 trees fill
}

TEST(View, SeesSpheresInItsCone) {
  View view;
  view.half_angle = 0.5;
  EXPECT_TRUE(view.sees(Vec3(10, 0, 0), 1.0));
  EXPECT_FALSE(view.sees(Vec3(-10, 0, 0), 1.0));
  EXPECT_TRUE(view.sees(Vec3(-0.5, 0, 0), 1.0));  // within the sphere
  EXPECT_FALSE(view.sees(Vec3(10, 9, 0), 1.0));
  EXPECT_TRUE(view.sees(Vec3(10, 9, 0), 6.0));  // at its edge
}

TEST(TreeSet, GrowsInStepsAndEndsWithLight) {
  const ForestReplica replica = replicaOf(forest::gridLayout(4, 8.0));
  TreeSet tree_set(replica, nearestTrees(replica.layout(), Vec3::Zero(), 100));
  EXPECT_FALSE(tree_set.ready());
  int steps = 0;
  while (!tree_set.grow(replica, FROM_SOUTH_WEST, true, 1e-9)) ++steps;
  EXPECT_EQ(steps, 16);  // one tree per step, and then the light
  EXPECT_TRUE(tree_set.ready());
  const Vec3 under(8.5, 8.5, 1.0), outside(-15.0, -15.0, 0.5);
  EXPECT_LT(tree_set.light().sky(under), 0.8);
  EXPECT_GT(tree_set.light().sky(outside), tree_set.light().sky(under));
}

// Compares the single-precision path of the display with the double-precision path of the core.
TEST(DrawnTree, StandsAsTheReplicaSays) {
  ForestReplica replica = replicaOf(forest::gridLayout(2, 12.0));
  replica.setWind(wind::Field({forest::makeDisk(1, Vec3(5, 5, 0), 40.0, Vec3(9.0, 4.0, 0.0))}));
  forest::StateUpdate update;
  update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
  update.layout_hash = replica.layoutHash();
  ASSERT_TRUE(replica.apply(update));
  const TreeSet tree_set = grown(replica, {0, 1, 2, 3});
  DrawnTree& tree = *tree_set.trees()[2];
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}}, tree_set.light(), TreeLook());
  const Nanoseconds stamp = fromSeconds(3.3);
  TreeLook still;
  still.flutter = false;
  ASSERT_TRUE(tree.move(replica, stamp, replica.wind().at(stamp), still, 100.0));
  const std::vector<Pose> poses = replica.pose(tree.tree(), tree.id(), stamp);
  forest::TreeMesh mesh = forest::buildMesh(tree.tree().skeleton, replica.layout().species[2],
                                            forest::meshDetail(forest::GEOMETRY_LEVELS - 1));
  finishLimbEnds(tree.tree().skeleton, mesh);
  ASSERT_EQ(3 * mesh.bark.size(), tree.shapes().front().bark.positions.size());
  for (std::size_t i = 0; i < mesh.bark.size(); ++i) {
    const forest::BarkVertex& v = mesh.bark[i];
    const Pose& pose = poses[static_cast<std::size_t>(v.branch)];
    const Vec3 expected = tree.foot() + pose.position +
                          rotate(pose.orientation, Vec3(v.local[0], v.local[1], v.local[2]));
    const float* at = &tree.shapes().front().bark.positions[3 * i];
    // The limit is 1e-5 of the tree's height plus single precision at some ten metres.
    ASSERT_LT(length(tree_set.origin() + Vec3(at[0], at[1], at[2]) - expected), 2e-4);
  }
}

TEST(DrawnTree, RestsWhereNothingMovesIt) {
  ForestReplica replica = replicaOf(forest::gridLayout(1, 12.0));
  const TreeSet tree_set = grown(replica, {0});
  DrawnTree& tree = *tree_set.trees()[0];
  EXPECT_FALSE(tree.move(replica, 1, wind::Instant(), TreeLook(), 100.0));  // There is no mesh yet.
  tree.setLevels({2, {}}, tree_set.light(), TreeLook());
  EXPECT_TRUE(tree.move(replica, 1, wind::Instant(), TreeLook(), 100.0));
  EXPECT_FALSE(tree.move(replica, 2, wind::Instant(), TreeLook(), 100.0));
}

// Paper 1, fig. 4: joints that move, joints in transition and joints at rest have different
// colours.
TEST(DrawnTree, IsPaintedByState) {
  Layout layout = forest::gridLayout(1, 12.0);
  layout.motion.transition = 2.0;
  ForestReplica replica = replicaOf(layout);
  const TreeSet tree_set = grown(replica, {0});
  DrawnTree& tree = *tree_set.trees()[0];
  TreeLook look;
  look.colours = TreeColours::BY_STATE;
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}}, tree_set.light(), look);
  forest::StateUpdate update;
  update.layout_hash = replica.layoutHash();
  forest::StateUpdate::Entry entry;
  entry.state = forest::LevelState::settled(1);
  forest::setLevel(entry.state, 2, fromSeconds(10.0), 2.0);
  update.stamp = fromSeconds(10.0);
  update.trees = {entry};
  ASSERT_TRUE(replica.apply(update));
  ASSERT_TRUE(tree.paintStates(replica, fromSeconds(11.0), look));
  EXPECT_FALSE(tree.paintStates(replica, fromSeconds(11.0), look));
  int red = 0, green = 0, bark = 0;
  for (const VertexPaint& paint : tree.shapes().front().bark.paint) {
    if (paint.colour[0] > 3 * paint.colour[1])
      ++red;
    else if (paint.colour[1] > 2 * paint.colour[0])
      ++green;
    else
      ++bark;
  }
  EXPECT_GT(red, 20);
  EXPECT_GT(green, 20);
  EXPECT_GT(bark, 20);
  // Held branches are yellow, and nothing else changes.
  ASSERT_TRUE(tree.paintStates(replica, fromSeconds(11.0), look, {0}));
  EXPECT_FALSE(tree.paintStates(replica, fromSeconds(11.0), look, {0}));
  const auto& mesh = tree.shapes().front();
  int yellow = 0;
  for (std::size_t i = 0; i < mesh.mesh.bark.size(); ++i) {
    const auto& colour = mesh.bark.paint[i].colour;
    const bool is_yellow = colour[0] > 3 * colour[2] && colour[1] > 3 * colour[2];
    EXPECT_EQ(is_yellow, mesh.mesh.bark[i].branch == 0) << i;
    yellow += is_yellow;
  }
  EXPECT_GT(yellow, 4);
  EXPECT_TRUE(tree.paintStates(replica, fromSeconds(11.0), look));
  EXPECT_TRUE(tree.paintStates(replica, fromSeconds(11.0), TreeLook()));
}

TEST(GroundPicture, IsDarkerUnderTreesAndInTheirShadow) {
  const ForestReplica replica = replicaOf(forest::gridLayout(1, 12.0));
  const TreeSet tree_set = grown(replica, {0});
  const Plot plot = plotAround(tree_set.extent());
  constexpr int EDGE = 128;
  const Daylight light = daylightOf(-2.356194, 0.75);  // light from the south-west
  const std::vector<float> shadows =
      shadowsOn(plot, EDGE, tree_set, replica.terrain(), light.to_sun);
  const auto shadowAt = [&](double x, double y) {
    const int c = static_cast<int>((x - plot.x) / plot.edge * EDGE);
    const int r = static_cast<int>((y - plot.y) / plot.edge * EDGE);
    return shadows[static_cast<std::size_t>(r * EDGE + c)];
  };
  EXPECT_LT(shadowAt(5.5, 5.5), 0.6f);  // the shadow of the crown lies to the north-east
  EXPECT_GT(shadowAt(-6.0, -6.0), 0.95f);
  const Image picture =
      groundPicture(plot, EDGE, tree_set, replica.terrain(), light, {1.f, 1.f, 1.f, 1.f});
  const auto greenAt = [&](double x, double y) {
    const int c = static_cast<int>((x - plot.x) / plot.edge * EDGE);
    const int r = EDGE - 1 - static_cast<int>((y - plot.y) / plot.edge * EDGE);
    return picture.at(c, r)[1];
  };
  EXPECT_LT(greenAt(5.5, 5.5), 0.75f * greenAt(-8.0, -8.0));
}

TEST(GroundPicture, BareTreesThrowThinShadows) {
  const ForestReplica replica = replicaOf(forest::gridLayout(1, 12.0));
  const auto lit = [&](bool leaves) {
    const TreeSet tree_set = grown(replica, {0}, leaves);
    double sum = 0.0;
    for (const float part :
         shadowsOn(plotAround(tree_set.extent()), 64, tree_set, replica.terrain(), FROM_SOUTH_WEST))
      sum += static_cast<double>(part) / (64 * 64);
    return sum;
  };
  EXPECT_GT(lit(false), lit(true) + 0.005);
}

TEST(GrainPicture, HasAMeanOfOneHalf) {
  const Image grain = grainPicture(128);
  for (std::size_t i = 0; i < 4; ++i) {
    double sum = 0.0;
    for (const Rgba& pixel : grain.pixels) sum += static_cast<double>(pixel[i]) / (128 * 128);
    EXPECT_NEAR(sum, 0.5, 1e-4) << i;
  }
}

}  // namespace
}  // namespace vegetation_sim::view

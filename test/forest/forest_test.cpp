// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/forest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/forest/level_scene.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds FOREST_START = 1700000000LL * NANOSECONDS_PER_SECOND;

Viewpoint lookFrom(const Vec3& position) {
  Viewpoint out;
  out.position = position;
  out.pixels_per_radian = 1000.0;
  return out;
}

Sensor sensorAt(const Vec3& position, Nanoseconds stamp) {
  return {"lidar", position, 15.0, 0.02, stamp};
}

Body bodyAt(const Vec3& position, Nanoseconds stamp) {
  Body out;
  out.id = "arm";
  out.pose.position = position;
  out.stamp = stamp;
  return out;
}

Forest makeForest(Layout layout = gridLayout(4, 10.0)) {
  return Forest(std::move(layout), flatTerrain(), Settings());
}

void run(Forest& forest, Nanoseconds from, double for_seconds,
         std::vector<Viewpoint> viewers = {}) {
  const TickGrid grid(30);
  const std::int64_t first = grid.tickAt(from);
  forest.setViewers(std::move(viewers));
  for (std::int64_t k = first; k < first + static_cast<std::int64_t>(30 * for_seconds); ++k)
    forest.advance(grid.timeOf(k));
}

// N8: without a viewer every tree has the fixed level, and takes no memory for it.
TEST(Forest, FixedLevelWithoutViewer) {
  Forest forest = makeForest();
  run(forest, FOREST_START, 1.0);
  EXPECT_EQ(forest.view().levels.of(3).level, 2);
  EXPECT_TRUE(forest.view().levels.held().empty());
}

// S1-01, S1-22, N8: two trees at different distances get different levels; moving the camera swaps
// them.
TEST(Forest, LevelsFollowTheViewer) {
  Layout layout = gridLayout(1, 1.0);
  layout.trees.push_back(layout.trees[0]);
  layout.trees[1].position = Vec3(400, 0, 0);
  Forest forest = makeForest(layout);
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  const Viewpoint here = lookFrom(Vec3(-10, 0, 2)), there = lookFrom(Vec3(410, 0, 2));
  run(forest, FOREST_START, 2.0, {here});
  EXPECT_GT(forest.view().levels.of(0).level, forest.view().levels.of(1).level);
  run(forest, FOREST_START + seconds(2), 5.0, {there});
  EXPECT_LT(forest.view().levels.of(0).level, forest.view().levels.of(1).level);
}

// S1-40: trees out of sight stand still, and move again when the camera turns to them.
TEST(Forest, TreesOutOfSightStandStill) {
  Forest forest = makeForest(gridLayout(2, 60.0));
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  Viewpoint eye = lookFrom(Vec3(30, 0, 2));
  eye.cone_cosine = 0.88;
  forest.setViewers({eye});
  forest.advance(FOREST_START);
  EXPECT_EQ(forest.view().levels.of(0).level, 0);  // at x = 0, behind
  EXPECT_GT(forest.view().levels.of(1).level, 0);  // at x = 60, in front
  eye.forward = Vec3(-1, 0, 0);
  forest.setViewers({eye});
  forest.advance(FOREST_START + seconds(0.1));
  EXPECT_GT(forest.view().levels.of(0).level, 0);
  EXPECT_EQ(forest.view().levels.of(1).level, 0);
}

// N8: of several viewers, the finest wins; without any, trees return to the fixed level.
TEST(Forest, FinestOfSeveralViewersWins) {
  Forest forest = makeForest();
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  const Viewpoint far = lookFrom(Vec3(5000, 0, 0));
  run(forest, FOREST_START, 0.1, {far});
  const int far_level = forest.view().levels.of(0).level;
  run(forest, FOREST_START + seconds(0.1), 0.1, {far, lookFrom(Vec3(5, 5, 2))});
  EXPECT_GT(forest.view().levels.of(0).level, far_level);
  run(forest, FOREST_START + seconds(0.2), 0.1);
  EXPECT_EQ(forest.view().levels.of(0).level, Settings().fixed_level);
}

// S1-22, S1-40: level 0 without wind; the middle of a disk requires more than its rim.
TEST(Forest, LevelsFollowTheWind) {
  Forest forest = makeForest(gridLayout(8, 20.0));
  forest.setWind(wind::Field({makeDisk(1, Vec3(0, 0, 0), 60.0, Vec3(11, 0, 0))}));
  forest.setViewers({lookFrom(Vec3(70, 70, 150))});
  forest.advance(FOREST_START);
  const auto level = [&](std::uint32_t x, std::uint32_t y) {
    return forest.view().levels.of(y * 8 + x).level;
  };
  EXPECT_EQ(level(7, 7), 0);
  EXPECT_GT(level(0, 0), 0);
  EXPECT_GT(level(0, 0), level(2, 1));
}

// S1-40: each further wind at a tree requires finer levels; winds that do not reach it change
// nothing.
TEST(Forest, LevelsRiseWithTheNumberOfWinds) {
  std::vector<int> levels;
  std::vector<wind::Primitive> winds;
  for (std::uint32_t id = 1; id <= 40; ++id) {
    winds.push_back(makeDisk(id, Vec3::Zero(), 60.0, Vec3(0.2, 0, 0)));
    for (const bool far_too : {false, true}) {
      std::vector<wind::Primitive> all = winds;
      if (far_too) all.push_back(makeDisk(1000, Vec3(5000, 0, 0), 60.0, Vec3(90, 0, 0)));
      Forest forest = makeForest(gridLayout(1, 1.0));
      forest.setWind(wind::Field(all));
      forest.setViewers({lookFrom(Vec3(-20, 0, 5))});
      forest.advance(FOREST_START);
      const int level = forest.view().levels.of(0).level;
      if (far_too)
        EXPECT_EQ(level, levels.back()) << id;
      else
        levels.push_back(level);
    }
  }
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_LT(levels.front(), levels[9]);
  EXPECT_LT(levels[9], levels.back());
}

bool same(const LevelState& a, const LevelState& b) {
  return a.level == b.level && a.since == b.since && a.blend == b.blend;
}

bool same(const StateUpdate& a, const StateUpdate& b) {
  const auto alike = [](const StateUpdate::Entry& x, const StateUpdate::Entry& y) {
    return x.tree == y.tree && same(x.state, y.state);
  };
  return a.stamp == b.stamp && a.sequence == b.sequence && a.key_frame == b.key_frame &&
         a.hash == b.hash && a.wind_hash == b.wind_hash && same(a.base, b.base) &&
         std::equal(a.trees.begin(), a.trees.end(), b.trees.begin(), b.trees.end(), alike);
}

// N6: the same inputs give the same hashes; a restored snapshot continues alike.
TEST(Forest, IsDeterministicAndRestores) {
  Forest a = makeForest(), b = makeForest();
  const wind::Field field({makeBreeze(1, Vec3(5, 0, 0))});
  for (Forest* forest : {&a, &b}) {
    forest->setWind(field);
    forest->setSensor(sensorAt(Vec3(5, 5, 2), FOREST_START));
    forest->setBody(bodyAt(Vec3(1, 0, 1), FOREST_START));
    run(*forest, FOREST_START, 3.0);
  }
  EXPECT_EQ(a.hash(), b.hash());
  const ForestSnapshot saved = a.snapshot();
  EXPECT_FALSE(a.sensed().levels.held().empty());
  const auto go_on = [&] {
    a.removeBody("arm");
    run(a, FOREST_START + seconds(3), 5.0);  // the sensor is removed meanwhile
  };
  go_on();
  EXPECT_TRUE(a.sensed().levels.held().empty());
  const std::uint64_t later = a.hash();
  EXPECT_NE(later, b.hash());
  a.restore(saved);
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_TRUE(same(a.update(true), b.update(true)));
  go_on();
  EXPECT_EQ(a.hash(), later);
}

// Collects every message of a forest with a camera in front of it.
std::vector<StateUpdate> messages(Forest& forest, std::int64_t first, int count) {
  const TickGrid grid(30);
  std::vector<StateUpdate> out;
  for (std::int64_t tick = first; tick < first + count; ++tick) {
    forest.setViewers({lookFrom(Vec3(-20, 10, 5))});
    forest.advance(grid.timeOf(tick));
    out.push_back(forest.updateView(tick % 30 == 0));
  }
  return out;
}

// N6: a restored forest sends the same messages, and so does another forest with the same snapshot.
TEST(Forest, RestoredMemorySendsTheSameMessages) {
  Forest forest = makeForest();
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  const std::int64_t start = TickGrid(30).tickAt(FOREST_START);
  messages(forest, start, 20);
  forest.setViewers({lookFrom(Vec3(60, 60, 5))});
  forest.advance(TickGrid(30).timeOf(start + 20));  // its changes are not sent yet
  const ForestSnapshot saved = forest.snapshot();
  const StateUpdate unsent = forest.updateView(false);
  EXPECT_FALSE(unsent.trees.empty());
  const std::vector<StateUpdate> before = messages(forest, start + 21, 60);
  Forest other = makeForest();
  for (Forest* again : {&forest, &other}) {
    again->restore(saved);
    EXPECT_TRUE(same(again->updateView(false), unsent));
    const std::vector<StateUpdate> after = messages(*again, start + 21, 60);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_TRUE(same(after[i], before[i])) << i;
  }
}

// Time going backwards: after reset() the forest equals a fresh start.
TEST(Forest, ResetEqualsAFreshStart) {
  Forest used = makeForest(), fresh = makeForest();
  used.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  fresh.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  used.setSensor(sensorAt(Vec3(5, 5, 2), FOREST_START + seconds(10)));
  used.setBody(bodyAt(Vec3(1, 0, 1), FOREST_START + seconds(10)));
  run(used, FOREST_START + seconds(10), 3.0);
  EXPECT_FALSE(used.sensed().levels.held().empty());
  EXPECT_FALSE(used.world().levels.held().empty());
  used.reset();
  run(used, FOREST_START, 1.0);
  run(fresh, FOREST_START, 1.0);
  EXPECT_EQ(used.hash(), fresh.hash());
  EXPECT_TRUE(same(used.update(true), fresh.update(true)));
}

// S1-23, S1-45: a new duration of transitions changes the rate but not the present blend.
TEST(Forest, NewTransitionTimeMovesNoTree) {
  Forest forest = makeForest();
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  forest.advance(FOREST_START);
  forest.setViewers({lookFrom(Vec3(-20, 10, 5))});
  forest.advance(FOREST_START);
  const Nanoseconds midway = FOREST_START + seconds(0.5 * forest.layout().motion.transition);
  forest.advance(midway);
  const auto before = weightsAt(forest.view().levels.of(0), midway, forest.layout().motion);
  Layout slow = forest.layout();
  slow.motion.transition = 30.0;
  forest.setLayout(slow, flatTerrain());
  const auto after = weightsAt(forest.view().levels.of(0), midway, forest.layout().motion);
  for (std::size_t d = 0; d < MAX_DEPTHS; ++d) EXPECT_NEAR(after[d], before[d], 1e-6) << d;
}

TEST(Forest, HashSeesEveryPartOfTheState) {
  Forest forest = makeForest();
  forest.advance(FOREST_START);
  const std::uint64_t before = forest.hash();
  Settings settings;
  settings.tolerance = 1.5;
  forest.setSettings(settings);
  EXPECT_NE(forest.hash(), before);
  forest.setSettings(Settings());
  EXPECT_EQ(forest.hash(), before);
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  EXPECT_NE(forest.hash(), before);
}

// A replica with one key frame, or with a key frame and deltas, holds the same levels.
TEST(Forest, ReplicaFollowsKeyFramesAndDeltas) {
  Forest forest = makeForest();
  const wind::Field field(
      {makeBreeze(1, Vec3(5, 0, 0)), makeDisk(2, Vec3(9, 9, 0), 15, Vec3(4, 0, 0))});
  forest.setWind(field);
  ForestReplica steady, late;
  for (ForestReplica* replica : {&steady, &late}) {
    replica->setLayout(forest.layout(), flatTerrain());
    replica->setWind(field);
  }
  const TickGrid grid(30);
  for (int k = 0; k < 150; ++k) {
    const Nanoseconds now = FOREST_START + grid.timeOf(k);
    if (k == 40 || k == 100) forest.setViewers({lookFrom(Vec3(-20, 0, 5))});
    if (k == 70) forest.setViewers({lookFrom(Vec3(60, 60, 5))});
    forest.advance(now);
    const StateUpdate update = forest.updateView(k % 30 == 0);
    EXPECT_TRUE(steady.apply(update)) << steady.why();
    EXPECT_EQ(late.apply(k < 95 ? StateUpdate() : update), k >= 120) << k;
    for (std::uint32_t id = 0; id < 16; ++id) {
      EXPECT_EQ(steady.weights(id, now),
                weightsAt(forest.view().levels.of(id), now, forest.layout().motion))
          << k << " " << id;
    }
  }
  EXPECT_EQ(late.weights(5, FOREST_START + seconds(9)),
            steady.weights(5, FOREST_START + seconds(9)));
}

TEST(Forest, ReplicaIgnoresAGapUntilTheNextKeyFrame) {
  Forest forest = makeForest();
  ForestReplica replica;
  replica.setLayout(forest.layout(), flatTerrain());
  forest.advance(FOREST_START);
  EXPECT_TRUE(replica.apply(forest.update(true)));
  forest.update(false);
  EXPECT_FALSE(replica.apply(forest.update(false)));
  EXPECT_EQ(replica.why(), "messages were lost");
  EXPECT_FALSE(replica.apply(forest.update(false)));
  EXPECT_TRUE(replica.apply(forest.update(true)));
}

// Returns the largest visible error over two periods of the disks with settled levels.
double worstPixels(const TreeBatch& grove, const Forest& forest, const Camera& camera,
                   std::int64_t settled, int instants) {
  const TickGrid grid(30);
  double out = 0.0;
  for (int i = 0; i < instants; ++i) {
    const Nanoseconds stamp = grid.timeOf(settled + 11 * i);
    out = std::max(
        out, errorOfLevels(grove, forest, camera, forest.snapshot().wind.at(stamp), stamp).pixels);
  }
  return out;
}

// S1-40: the tolerance is the visible error: no tip exceeds it by more than a little, and it is not
// so much smaller that work is wasted.
TEST(Forest, PredictedErrorIsTheMeasuredOne) {
  const double spacing = 9.0, extent = 8 * spacing;
  const TreeBatch grove = growTrees(richLayout(8, spacing, 400));
  const TickGrid grid(30);
  const std::int64_t start = grid.tickAt(FOREST_START);
  for (const double tolerance : {0.5, 1.0, 2.0, 4.0}) {
    Settings settings;
    settings.tolerance = tolerance;
    for (const double x : {-60.0, -25.0, -12.0}) {
      Forest forest(grove.layout, flatTerrain(), settings);
      forest.setWind(threeDiscs(extent));
      Camera camera = edgeCamera(extent);
      camera.eye.position.x() = x;
      settle(forest, camera, grid, start, 90);
      const double seen = worstPixels(grove, forest, camera, start + 90, 10);
      std::printf("tolerance %.1f, eye at %.0f m: %.2f pixels\n", tolerance, x, seen);
      EXPECT_LE(seen, 1.25 * tolerance) << tolerance << " " << x;
      EXPECT_GE(seen, 0.25 * tolerance) << tolerance << " " << x;
    }
  }
}

// S1-41: at the default tolerance, levels pose at least 27 times fewer branches than the whole
// forest has, and no visible tip is more than a pixel from its place with all of them.
TEST(Forest, LevelsSaveWorkAtAPixel) {
  const double spacing = 8.0, extent = 16 * spacing;
  const TreeBatch grove = growTrees(richLayout(16, spacing, 2000));
  Forest forest(grove.layout, flatTerrain(), Settings());
  forest.setWind(threeDiscs(extent));
  const Camera camera = edgeCamera(extent);
  const TickGrid grid(30);
  const std::int64_t start = grid.tickAt(FOREST_START), ticks = 90;
  settle(forest, camera, grid, start, ticks);
  const Nanoseconds now = grid.timeOf(start + ticks);
  BatchPoses scratch;
  const std::size_t posed =
      poseAtLevels(grove, forest, forest.snapshot().wind.at(now), now, scratch);
  EXPECT_GT(posed, 0u);
  EXPECT_GT(grove.branches, 27 * posed);
  EXPECT_LE(worstPixels(grove, forest, camera, start + ticks, 20), 1.0);
}

// One tree of a million grows again with the same bits.
TEST(Forest, TreesOfTilesGrowAgainTheSame) {
  Layout layout = gridLayout(1, 1.0);
  layout.trees.clear();
  Tile tile;
  tile.count = 1000000;
  tile.seed = 7;
  tile.size = 5000.0;
  tile.mix = {1.f, 1.f, 1.f, 1.f};
  layout.tiles.push_back(tile);
  const auto hash = [&](std::uint32_t id) {
    return growTree(layout, id, terrain::HeightMap()).skeleton.hash();
  };
  EXPECT_EQ(hash(765432), hash(765432));
  EXPECT_NE(hash(765432), hash(765436));
}

}  // namespace
}  // namespace vegetation_sim::forest

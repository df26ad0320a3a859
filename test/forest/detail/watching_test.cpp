// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What displays look at changes nothing in the world.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/forest/physics_scene.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::forest {
namespace {

constexpr int TREES = 9;

/// Trees in a strong breeze with a lidar among them and a body that pushes through.
struct Landscape {
  Landscape() {
    forest.setWind(wind::Field({makeBreeze(1, Vec3(6.0, 2.0, 0.0))}, 3));
    for (ForestReplica* replica : {&sensed, &shown}) {
      replica->setLayout(forest.layout(), flatTerrain());
      replica->setWind(forest.snapshot().wind);
    }
    for (std::uint32_t id = 0; id < TREES; ++id)
      trees.push_back(growTree(forest.layout(), id, forest.terrain()));
  }
  void look(const Vec3& from, const Vec3& along) {
    Viewpoint eye;
    eye.position = from;
    eye.forward = along;
    eye.cone_cosine = 0.8;
    forest.setViewers({eye});
  }
  void advance() {
    const Nanoseconds stamp = grid.timeOf(++tick);
    forest.setSensor({"lidar", Vec3(6.0, 6.0, 1.5), 12.0, 0.02, stamp});
    forest.advance(stamp);
    const bool key_frame = ticks++ % 30 == 0;
    sensed.apply(forest.update(key_frame));
    shown.apply(forest.updateView(key_frame));
  }
  Nanoseconds now() const { return grid.timeOf(tick); }
  void hold(std::uint32_t tree, double aside) {
    Grab grab;
    grab.point = {tree, twigOf(tree), 0.0};
    grab.target = trees[tree].foot + forest.pose(trees[tree], tree, now())[branch(tree)].position +
                  Vec3(0.0, aside, 0.0);
    forest.addGrab(grab);
  }
  int twigOf(std::uint32_t tree) const { return trees[tree].skeleton.depth_end[2] - 1; }
  std::size_t branch(std::uint32_t tree) const { return static_cast<std::size_t>(twigOf(tree)); }

  Forest forest{gridLayout(3, 6.0), flatTerrain(), Settings()};
  ForestReplica sensed, shown;
  std::vector<Tree> trees;
  TickGrid grid{30};
  std::int64_t tick{TickGrid(30).tickAt(PHYSICS_START)};
  int ticks{0};
};

bool same(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Pose& x, const Pose& y) {
    return x.position == y.position && x.orientation.w == y.orientation.w &&
           x.orientation.x == y.orientation.x && x.orientation.y == y.orientation.y &&
           x.orientation.z == y.orientation.z;
  });
}

// Without viewers, with one that looks away and with one that looks at the trees: the same hashes,
// poses and updates for sensors at every tick, with modes and physical branches among them.
TEST(Watching, ChangesNothingThatSensorsAndBodiesMeet) {
  Landscape alone, away, near;
  int modal = 0, differing = 0;
  for (int k = 0; k < 240; ++k) {
    away.look(Vec3(-30.0, 6.0, 2.0), -Vec3::UnitX());
    near.look(Vec3(-30.0, 6.0, 2.0), Vec3::UnitX());
    for (Landscape* each : {&alone, &away, &near}) {
      if (k == 90) each->hold(4, 0.3);
      each->advance();
    }
    ASSERT_EQ(away.forest.hash(), alone.forest.hash()) << k;
    ASSERT_EQ(near.forest.hash(), alone.forest.hash()) << k;
    for (std::uint32_t id = 0; id < TREES; ++id) {
      const Nanoseconds stamp = alone.now();
      const auto pose = alone.forest.pose(alone.trees[id], id, stamp);
      for (const Landscape* each : {&alone, &away, &near}) {
        ASSERT_TRUE(same(each->forest.pose(each->trees[id], id, stamp), pose)) << k << " " << id;
        ASSERT_TRUE(same(each->sensed.pose(each->trees[id], id, stamp), pose)) << k << " " << id;
        ASSERT_TRUE(same(each->shown.pose(each->trees[id], id, stamp),
                         each->forest.poseInView(each->trees[id], id, stamp)))
            << k << " " << id;
      }
      differing += !same(near.forest.poseInView(near.trees[id], id, stamp), pose);
    }
    modal += static_cast<int>(alone.forest.world().modes.modalStates().size());
  }
  EXPECT_GT(modal, 0);
  EXPECT_GT(differing, 0);  // displays draw another detail
  EXPECT_FALSE(alone.forest.promoted(4).branches.empty());
}

// A tree out of the viewers' sight stands still in displays and moves for the sensor.
TEST(Watching, SensorGetsTheDetailThatItsToleranceRequires) {
  Landscape scene;
  for (int k = 0; k < 60; ++k) {
    scene.look(Vec3(-30.0, 6.0, 2.0), -Vec3::UnitX());
    scene.advance();
  }
  int finer = 0;
  for (std::uint32_t id = 0; id < TREES; ++id) {
    EXPECT_EQ(scene.forest.view().levels.of(id).level, 0) << id;
    finer += scene.forest.world().levels.of(id).level > Settings().fixed_level;
  }
  EXPECT_GT(finer, TREES / 2);
}

double distance(const Pose& a, const Pose& b) {
  return length(a.position - b.position);
}

// A promotion starts from the world's pose. Displays do not jump there but approach it: at the
// promotion a drawn branch moves about as far in a tick as the world's does, and a second later it
// is where the world has it.
TEST(Watching, DrawnBranchesDoNotJumpAtAPromotion) {
  Landscape scene;
  scene.forest.setWind(wind::Field({makeBreeze(1, Vec3(9.0, 2.0, 0.0))}, 3));
  for (ForestReplica* replica : {&scene.sensed, &scene.shown})
    replica->setWind(scene.forest.snapshot().wind);
  scene.look(Vec3(-30.0, 6.0, 2.0), -Vec3::UnitX());  // the drawn tree stands still
  for (int k = 0; k < 90; ++k) scene.advance();
  const auto world = [&] {
    return scene.forest.pose(scene.trees[4], 4, scene.now())[scene.branch(4)];
  };
  const auto drawn = [&] {
    return scene.forest.poseInView(scene.trees[4], 4, scene.now())[scene.branch(4)];
  };
  ASSERT_GT(distance(world(), drawn()), 0.05);  // else there is nothing to see
  scene.hold(4, 0.0);
  double world_step = 0.0, drawn_step = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Pose world_before = world(), drawn_before = drawn();
    scene.advance();
    world_step = std::max(world_step, distance(world(), world_before));
    drawn_step = std::max(drawn_step, distance(drawn(), drawn_before));
  }
  ASSERT_FALSE(scene.forest.promoted(4).branches.empty());
  std::printf("largest step in a tick: world %.4f m, drawn %.4f m\n", world_step, drawn_step);
  EXPECT_LT(drawn_step, world_step + 0.01);
}

}  // namespace
}  // namespace vegetation_sim::forest

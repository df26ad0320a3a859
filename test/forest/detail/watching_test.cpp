// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What displays look at and sensors announce changes nothing in the world, and what displays look
// at changes nothing that sensors perceive.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "scenes/forest/physics_scene.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::forest {
namespace {

constexpr int TREES = 9;

/// Trees in a strong breeze with a lidar among them, and a branch that is held.
struct Landscape {
  explicit Landscape(bool with_lidar = true) : lidar(with_lidar) {
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
    if (lidar) forest.setSensor({"lidar", Vec3(6.0, 6.0, 1.5), 12.0, 0.02, stamp});
    forest.advance(stamp);
    const bool key_frame = ticks++ % 30 == 0;
    sensed.apply(forest.update(key_frame));
    shown.apply(forest.updateView(key_frame));
  }
  Nanoseconds now() const { return grid.timeOf(tick); }
  std::vector<Pose> world(std::uint32_t tree) const {
    return forest.pose(trees[tree], tree, now());
  }
  std::vector<Pose> perceived(std::uint32_t tree) const {
    return forest.poseForSensors(trees[tree], tree, now());
  }
  std::vector<Pose> drawn(std::uint32_t tree) const {
    return forest.poseInView(trees[tree], tree, now());
  }
  void hold(std::uint32_t tree, double aside) {
    Grab grab;
    grab.point = {tree, twigOf(tree), 0.0};
    grab.target = trees[tree].foot + forest.pose(trees[tree], tree, now())[branch(tree)].position +
                  Vec3(0.0, aside, 0.0);
    forest.addGrab(grab);
  }
  int twigOf(std::uint32_t tree) const { return trees[tree].skeleton.depth_end[2] - 1; }
  std::size_t branch(std::uint32_t tree) const { return static_cast<std::size_t>(twigOf(tree)); }

  bool lidar;
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

/// The same trees without a listener, with a lidar, and with a viewer besides that looks away or at
/// the trees.
struct Listened {
  Landscape deaf{false}, alone, away, near;

  void advance() {
    away.look(Vec3(-30.0, 6.0, 2.0), -Vec3::UnitX());
    near.look(Vec3(-30.0, 6.0, 2.0), Vec3::UnitX());
    for (Landscape* each : {&deaf, &alone, &away, &near}) each->advance();
  }
  void hold() {
    for (Landscape* each : {&deaf, &alone, &away, &near}) each->hold(4, 0.3);
  }
  /// Expects equal worlds, equal perceptions, and replicas that agree with them.
  void expectEqual(std::uint32_t id) const {
    const auto world = deaf.world(id), perceived = alone.perceived(id);
    for (const Landscape* each : {&deaf, &alone, &away, &near}) {
      const Tree& tree = each->trees[id];
      ASSERT_TRUE(same(each->world(id), world)) << id;
      ASSERT_TRUE(same(each->perceived(id), each->lidar ? perceived : world)) << id;
      ASSERT_TRUE(same(each->sensed.pose(tree, id, each->now()), each->perceived(id))) << id;
      ASSERT_TRUE(same(each->shown.pose(tree, id, each->now()), each->drawn(id))) << id;
    }
  }
};

// Whoever listens: the same hashes and poses of the world at every tick. Whatever displays look at:
// the same poses and updates for sensors, with modes and physical branches among them.
TEST(Watching, ChangesNothingThatBodiesMeetOrSensorsPerceive) {
  Listened scene;
  int modal = 0, finer = 0, drawn_otherwise = 0;
  for (int k = 0; k < 240; ++k) {
    if (k == 90) scene.hold();
    scene.advance();
    for (const Landscape* each : {&scene.alone, &scene.away, &scene.near})
      ASSERT_EQ(each->forest.hash(), scene.deaf.forest.hash()) << k;
    for (std::uint32_t id = 0; id < TREES; ++id) {
      ASSERT_NO_FATAL_FAILURE(scene.expectEqual(id)) << k;
      finer += !same(scene.alone.perceived(id), scene.alone.world(id));
      drawn_otherwise += !same(scene.near.drawn(id), scene.near.perceived(id));
    }
    modal += static_cast<int>(scene.alone.forest.sensed().modes.modalStates().size());
  }
  EXPECT_GT(modal, 0);
  EXPECT_GT(finer, 0);
  EXPECT_GT(drawn_otherwise, 0);
  EXPECT_FALSE(scene.alone.forest.promoted(4).branches.empty());
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
    EXPECT_EQ(scene.forest.world().levels.of(id).level, Settings().fixed_level) << id;
    finer += scene.forest.sensed().levels.of(id).level > Settings().fixed_level;
  }
  EXPECT_GT(finer, TREES / 2);
}

double distance(const Pose& a, const Pose& b) {
  return length(a.position - b.position);
}

// A promotion starts from the world's pose. Listeners do not jump there but approach it: at the
// promotion a drawn or perceived branch moves about as far in a tick as the world's does, and a
// second later it is where the world has it.
void expectNoJump(int world_level) {
  Landscape scene;
  Settings settings;
  settings.fixed_level = world_level;
  scene.forest.setSettings(settings);
  scene.forest.setWind(wind::Field({makeBreeze(1, Vec3(12.0, 2.0, 0.0))}, 3));
  for (ForestReplica* replica : {&scene.sensed, &scene.shown})
    replica->setWind(scene.forest.snapshot().wind);
  scene.look(Vec3(-30.0, 6.0, 2.0), -Vec3::UnitX());  // the drawn tree stands still
  for (int k = 0; k < 90; ++k) scene.advance();
  const auto now = [&] {
    const std::size_t b = scene.branch(4);
    return std::array<Pose, 3>{scene.world(4)[b], scene.perceived(4)[b], scene.drawn(4)[b]};
  };
  const auto [world, perceived, drawn] = now();
  std::printf("before: world and perceived differ by %.4f m, world and drawn by %.4f m\n",
              distance(world, perceived), distance(world, drawn));
  // Else there is nothing to see.
  ASSERT_GT(std::max(distance(world, drawn), distance(world, perceived)), 0.05);
  scene.hold(4, 0.0);
  std::array<double, 3> step{};
  for (int k = 0; k < 3; ++k) {
    const auto before = now();
    scene.advance();
    for (std::size_t i = 0; i < 3; ++i) step[i] = std::max(step[i], distance(now()[i], before[i]));
  }
  ASSERT_FALSE(scene.forest.promoted(4).branches.empty());
  std::printf("largest step in a tick: world %.4f m, perceived %.4f m, drawn %.4f m\n", step[0],
              step[1], step[2]);
  EXPECT_LT(step[1], step[0] + 0.01);
  EXPECT_LT(step[2], step[0] + 0.01);
}

TEST(Watching, DrawnBranchesDoNotJumpAtAPromotion) {
  expectNoJump(3);
}

TEST(Watching, PerceivedBranchesDoNotJumpAtAPromotion) {
  expectNoJump(0);  // the world's tree stands still until then, for sensors it sways
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/detail_chooser.h"

#include <gtest/gtest.h>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

/// Four large oaks, whose modes a body above them and a sensor require.
struct LargeTrees : Clearing {
  LargeTrees() : Clearing(breeze(), 0.05) {
    forest.setLayout(fourOaks(1200), flatTerrain());
    requireOfTheWorld();
  }
  int countFine() const {
    int out = 0;
    for (std::uint32_t id = 0; id < 4; ++id) {
      const ModalTreeState* state = forest.world().modes.find(id);
      out += state && state->fine();
    }
    return out;
  }
};

// N13: no tick computes the modes of a large tree; they start when it was said that they would.
TEST(DetailChooser, LargeTreesGetTheirModesFromAnotherThreadAtAStatedTick) {
  LargeTrees scene;
  int started = 0;
  for (int i = 0; i < 10 * TICK_RATE && scene.countFine() < 4; ++i) {
    const std::optional<ModesRequest> before = scene.forest.world().request;
    const Nanoseconds last = scene.now();
    scene.advance();
    EXPECT_FALSE(scene.forest.worldChoice().hasComputed()) << i;
    EXPECT_FALSE(scene.forest.sensorChoice().hasComputed()) << i;
    if (!before) continue;
    const bool is_turn = ModalForest::fineDue(last, scene.now());
    const bool is_due = scene.now() >= before->due && (is_turn || !before->fine);
    const ModalTreeState* state = scene.forest.world().modes.find(before->tree, before->fine);
    EXPECT_EQ(state != nullptr, is_due) << i;
    started += is_due;
  }
  EXPECT_EQ(scene.countFine(), 4);
  EXPECT_GE(started, 4);
}

// N6: a forest that continues from bytes has no computation that runs; it must wait at the tick.
TEST(DetailChooser, RequestsAreInSnapshots) {
  LargeTrees first, second;
  while (!first.forest.world().request) first.advance();
  for (int i = 0; i < 3; ++i) first.advance();
  const std::string bytes = first.forest.archived();
  second.forest.restore(second.forest.readArchived(bytes));
  second.tick = first.tick;
  EXPECT_EQ(second.forest.archived(), bytes);
  EXPECT_EQ(second.forest.hash(), first.forest.hash());
  for (int i = 0; i < 2 * TICK_RATE; ++i) {
    for (LargeTrees* each : {&first, &second}) each->advance();
    ASSERT_EQ(second.forest.hash(), first.forest.hash()) << i;
    ASSERT_EQ(second.forest.update(i % 30 == 0).trees.size(),
              first.forest.update(i % 30 == 0).trees.size());
  }
  EXPECT_GT(first.countFine(), 0);
}

// The request of a tree that needs no modes any more ends, and so does that of another layout.
TEST(DetailChooser, RequestsEndWithTheirPurpose) {
  LargeTrees scene;
  while (!scene.forest.world().request) scene.advance();
  scene.settings.budget.modal_trees = 0;
  scene.use();
  scene.advance();
  EXPECT_FALSE(scene.forest.world().request.has_value());
  scene.settings.budget.modal_trees = 4;
  scene.use();
  scene.advance();
  ASSERT_TRUE(scene.forest.world().request.has_value());
  const std::uint64_t with = scene.forest.hash();
  ForestSnapshot snapshot = scene.forest.snapshot();
  snapshot.world.request.reset();
  EXPECT_NE(scene.forest.hashOf(snapshot), with);
  scene.forest.setLayout(fourOaks(1100), flatTerrain());
  EXPECT_FALSE(scene.forest.world().request.has_value());
}

double meanDistance(const std::vector<StateUpdate::Entry>& trees, const Layout& layout,
                    const Vec3& from) {
  double sum = 0.0;
  for (const StateUpdate::Entry& entry : trees)
    sum += length(layout.trees[entry.tree].position - from);
  return sum / static_cast<double>(trees.size());
}

// N7: in each tick the levels that change for sensors and for displays keep to their bytes; those
// with the largest errors, near a viewer, come first, and in the end all have come.
TEST(DetailChooser, LevelsOfListenersChangeWithinTheirBytes) {
  constexpr int RATE = 240, TICKS = 12;
  Settings settings;
  settings.tolerance = 0.02;
  settings.budget.modal_trees = 0;
  settings.budget.frame_time = 1e6;
  Forest forest(gridLayout(40, 6.0), flatTerrain(), settings);
  forest.setWind(breeze());
  const TickGrid grid(RATE);
  std::int64_t tick = grid.tickAt(PHYSICS_START);
  forest.advance(grid.timeOf(tick));
  forest.update(true);
  forest.updateView(true);
  Viewpoint eye;  // sees all round, from a corner
  eye.position = Vec3(-5.0, -5.0, 3.0);
  forest.setViewers({eye});
  // Stamps of ticks are rounded.
  const auto most = static_cast<std::size_t>(DELTA_BYTES / ENTRY_BYTES / RATE) + 1;
  std::vector<std::vector<StateUpdate::Entry>> sensed, seen;
  std::size_t of_sensors = 0, of_displays = 0;
  for (int i = 0; i < TICKS; ++i) {
    const Nanoseconds stamp = grid.timeOf(++tick);
    forest.setSensor({"lidar", eye.position, 1000.0, 1e-3, stamp});
    forest.advance(stamp);
    sensed.push_back(forest.update(false).trees);
    seen.push_back(forest.updateView(false).trees);
    EXPECT_LE(sensed.back().size(), most) << i;
    EXPECT_LE(seen.back().size(), most) << i;
    of_sensors += sensed.back().size();
    of_displays += seen.back().size();
  }
  EXPECT_GT(of_sensors, 2 * most);
  EXPECT_GT(of_displays, 3 * most);
  EXPECT_LT(sensed.back().size(), most / 10);
  EXPECT_LT(seen.back().size(), most / 10);
  for (const Plant& plant : forest.sensorChoice().plants())
    EXPECT_EQ(forest.sensed().levels.of(plant.id).level, plant.chosen) << plant.id;
  const Layout& layout = forest.layout();
  EXPECT_LT(meanDistance(seen[0], layout, eye.position),
            meanDistance(seen[2], layout, eye.position));
}

}  // namespace
}  // namespace vegetation_sim::forest

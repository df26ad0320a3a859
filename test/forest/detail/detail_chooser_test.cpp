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

}  // namespace
}  // namespace vegetation_sim::forest

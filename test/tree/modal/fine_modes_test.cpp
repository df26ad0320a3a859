// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

// N7, N13: a tree whose plain modes have too large an error continues in fine ones without a jump,
// and a replica poses it with the same bits.
TEST(ModalTreeState, GoesOnInFineModesWithoutAJump) {
  Clearing probe;
  probe.advance();
  const Plant& near = probe.forest.sensorChoice().plants().front();
  ASSERT_EQ(near.id, 0u);
  const float plain = near.error[MODAL_LEVEL], fine = near.error[FINE_MODAL_TIER];
  ASSERT_LT(fine, 0.8f * plain);
  Clearing scene;
  ForestReplica replica;
  scene.introduce(replica);
  const Tree tree = scene.tree(0);
  double jump = 0.0, peak = 0.0;
  for (int i = 0; i < 3 * TICK_RATE; ++i) {
    scene.tolerate((i < 2 * TICK_RATE ? 1.1 : 0.9) * static_cast<double>(plain));
    const auto before = scene.angles(tree, 0, scene.grid.timeOf(scene.tick + 1));
    scene.advance();
    ASSERT_TRUE(replica.apply(scene.forest.update(i % TICK_RATE == 0))) << replica.why();
    const auto after = scene.angles(tree, 0, scene.now());
    const auto here = scene.forest.poseForSensors(tree, 0, scene.now()),
               there = replica.pose(tree, 0, scene.now());
    for (std::size_t b = 0; b < after.size(); ++b) {
      jump = std::max(jump, difference(before[b], after[b]));
      peak = std::max(peak, difference(after[b], {}));
      ASSERT_EQ(here[b].position, there[b].position) << i << " " << b;
    }
    if (i == 2 * TICK_RATE - 1) {
      ASSERT_NE(scene.forest.sensed().modes.find(0), nullptr);
      EXPECT_FALSE(scene.forest.sensed().modes.find(0)->fine());
    }
  }
  EXPECT_TRUE(scene.forest.sensed().modes.find(0)->fine());
  std::printf("largest jump %.1e rad of %.2f\n", jump, peak);
  EXPECT_LT(jump, 0.1 / 57.3);
}

// N7: a tree that loses fine modes for lack of bytes gets plain ones once those have faded, and
// keeps them: no tier changes more than once a second, and messages are short.
TEST(ModalTreeState, FineModesThatAreLostDoNotFlicker) {
  Clearing scene;
  scene.advance();
  scene.tolerate(
      0.9 * static_cast<double>(scene.forest.sensorChoice().plants().front().error[MODAL_LEVEL]));
  scene.run(2.0);
  ASSERT_NE(scene.forest.sensed().modes.find(0), nullptr);
  ASSERT_TRUE(scene.forest.sensed().modes.find(0)->fine());
  scene.publishAtMost(500);
  std::map<std::uint32_t, int> changes, published;
  for (int i = 0; i < 5 * TICK_RATE; ++i) {
    const LevelMap before = scene.forest.sensed().levels;
    scene.advance();
    for (std::uint32_t tree = 0; tree < 4; ++tree)
      changes[tree] += scene.forest.sensed().levels.of(tree).level != before.of(tree).level;
    for (const auto& entry : scene.forest.update(false).trees)
      published[entry.tree] += !entry.modal.amplitude.empty();
  }
  for (std::uint32_t tree = 0; tree < 4; ++tree) {
    EXPECT_LE(changes[tree], 2) << tree;  // to its levels, to plain modes
    EXPECT_LE(published[tree], 3) << tree;
  }
  ASSERT_EQ(scene.forest.sensed().modes.modalStates().size(), 1u);  // the bytes suffice for one
  EXPECT_FALSE(scene.forest.sensed().modes.modalStates().begin()->second.fine());
}

}  // namespace
}  // namespace vegetation_sim::forest

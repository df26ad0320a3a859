// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

// N13: key frames have amplitudes; between them a replica steps the modes itself. Late and early
// subscribers pose every branch with the bits of the forest.
TEST(ModalTreeState, ReplicasSwayToTheBit) {
  Clearing scene;
  scene.publishAtMost(1600);  // plain modes, computed at once
  ForestReplica steady, late;
  for (ForestReplica* replica : {&steady, &late}) scene.introduce(*replica);
  const Tree tree = scene.tree(2);
  std::size_t published = 0;
  for (int i = 0; i < 3 * TICK_RATE; ++i) {
    if (i == 2 * TICK_RATE - 20) scene.look(false);
    scene.advance();
    const StateUpdate update = scene.forest.update(i % TICK_RATE == 0);
    for (const auto& entry : update.trees) published += !entry.modal.amplitude.empty();
    ASSERT_TRUE(steady.apply(update)) << steady.why();
    const bool joined = i >= TICK_RATE;
    ASSERT_EQ(joined && late.apply(update), joined) << late.why();
    if (i % 7 && i % TICK_RATE) continue;  // key frames too: extrapolation gives the same bits
    const Nanoseconds stamp = scene.now() + seconds(0.005);
    const auto here = scene.forest.poseForSensors(tree, 2, stamp);
    for (const ForestReplica* replica : {&steady, &late}) {
      if (replica == &late && !joined) continue;
      const auto there = replica->pose(tree, 2, stamp);
      for (std::size_t b = 0; b < here.size(); ++b) {
        ASSERT_EQ(here[b].position, there[b].position) << i << " " << b;
        ASSERT_EQ(here[b].orientation.w, there[b].orientation.w) << i << " " << b;
      }
    }
  }
  // If every tick of 3 s at 60 Hz sent amplitudes there would be 180.
  EXPECT_LT(published, 4u * 15u);
}

// N1, N13: one key frame is enough for a sensor that joins late, although several trees have fine
// modes: it has the bits of the forest at once.
TEST(ModalTreeState, OneKeyFrameRestoresAllFineModes) {
  Clearing scene(breeze(), 0.05);
  scene.run(2.0);
  ForestReplica late;
  scene.introduce(late);
  ASSERT_TRUE(late.apply(scene.forest.update(true))) << late.why();
  for (std::uint32_t id = 0; id < 4; ++id) {
    ASSERT_TRUE(late.modalState(id) && late.modalState(id)->fine()) << id;
    const Tree tree = scene.tree(id);
    const auto here = scene.forest.poseForSensors(tree, id, scene.now()),
               there = late.pose(tree, id, scene.now());
    for (std::size_t b = 0; b < here.size(); ++b) ASSERT_EQ(here[b].position, there[b].position);
  }
}

// What a message costs is bounded: a sensor computes the fine modes of 64 trees at once, and those
// of the others one by one.
TEST(ModalTreeState, OneMessageComputesTheFineModesOf64Trees) {
  constexpr std::uint32_t TREES = 66, AT_ONCE = 64;
  Layout layout = gridLayout(9, 12.0);
  Design design;
  design.children = 0.5;
  for (Species& species : layout.species) species = applyDesign(species, design);
  ForestReplica late;
  late.setLayout(layout, flatTerrain());
  late.setWind(breeze());
  const auto flat = flatTerrain();
  const wind::Field calm;
  StateUpdate update;
  update.layout_hash = layout.hash();
  for (std::uint32_t id = 0; id < TREES; ++id) {
    ModalForest reference;
    reference.addTree({layout, *flat, calm}, id, true, PHYSICS_START);
    const std::vector<double> none(reference.find(id)->modes().size());
    update.trees.push_back({id, LevelState::settled(MODAL_LEVEL), {}, {none, none}});
  }
  for (std::uint32_t round = 0; round < 3; ++round) {
    update.key_frame = true;
    update.stamp = PHYSICS_START + seconds(round);
    ASSERT_TRUE(late.apply(update)) << late.why();
    std::uint32_t computed = 0;
    for (std::uint32_t id = 0; id < TREES; ++id) computed += late.modalState(id) != nullptr;
    EXPECT_EQ(computed, round == 0 ? AT_ONCE + 1 : TREES) << round;
  }
}

// N13: displays that join late compute fine modes one by one, so that no frame is late. Waiting
// trees move procedurally, and all have the same bits in the end.
TEST(ModalTreeState, WhoJoinsLateFindsFineModesOneByOne) {
  Clearing scene(breeze(), 0.05);
  scene.run(2.0);
  for (std::uint32_t id = 0; id < 4; ++id) {
    ASSERT_NE(scene.forest.sensed().modes.find(id), nullptr) << id;
    ASSERT_TRUE(scene.forest.sensed().modes.find(id)->fine()) << id;
  }
  ForestReplica late(ForestReplica::FineModes::ONE_BY_ONE);
  scene.introduce(late);
  for (int i = 0; i <= TICK_RATE; ++i) {
    scene.advance();
    ASSERT_TRUE(late.apply(scene.forest.update(i % TICK_RATE == 0))) << late.why();
    int found = 0;
    for (std::uint32_t id = 0; id < 4; ++id) found += late.modalState(id) != nullptr;
    EXPECT_EQ(found, i < TICK_RATE ? 1 : 4) << i;
  }
  for (std::uint32_t id = 0; id < 4; ++id) {
    const Tree tree = scene.tree(id);
    const auto here = scene.forest.poseForSensors(tree, id, scene.now()),
               there = late.pose(tree, id, scene.now());
    for (std::size_t b = 0; b < here.size(); ++b) ASSERT_EQ(here[b].position, there[b].position);
  }
}

// N13: a replica with plain modes that lost messages and gets fine ones in a key frame does not
// continue the old ones over a long step.
TEST(ModalTreeState, NothingStaleIsShownWhileFineModesAreAwaited) {
  Clearing scene(breeze(), 0.05);
  scene.publishAtMost(1600);  // plain modes
  scene.run(2.0);
  ForestReplica replica(ForestReplica::FineModes::ONE_BY_ONE);
  scene.introduce(replica);
  ASSERT_TRUE(replica.apply(scene.forest.update(true)));
  for (std::uint32_t id = 0; id < 4; ++id) ASSERT_NE(replica.modalState(id), nullptr);
  scene.publishAtMost(1000000);
  scene.run(2.0);  // without messages
  for (std::uint32_t id = 0; id < 4; ++id)
    ASSERT_TRUE(scene.forest.sensed().modes.find(id)->fine()) << id;
  for (int i = 0; i < 5; ++i) {
    scene.advance();
    ASSERT_TRUE(replica.apply(scene.forest.update(i == 0))) << replica.why();
    int shown = 0;
    for (std::uint32_t id = 0; id < 4; ++id) {
      if (!replica.modalState(id)) continue;
      ++shown;
      EXPECT_TRUE(replica.modalState(id)->fine()) << id;
      EXPECT_EQ(replica.modalState(id)->state().amplitude,
                scene.forest.sensed().modes.find(id)->state().amplitude);
    }
    EXPECT_EQ(shown, 1);
  }
}

// Grabbed branches are sent at every tick, the amplitudes of their tree are not.
TEST(ModalTreeState, AHeldTreeTellsItsAmplitudesInKeyFramesOnly) {
  Clearing scene(breeze(), 0.1);
  scene.run(1.0);
  scene.forest.update(true);
  const Tree tree = scene.tree(0);
  Grab grab;
  grab.point = {0, static_cast<int>(tree.skeleton.branches.size()) - 1, 0.0};
  grab.target = tree.foot + tree.skeleton.branches.back().rest.position + Vec3(0.2, 0.0, 0.0);
  scene.forest.addGrab(grab);
  for (int i = 1; i <= 30; ++i) {
    scene.advance();
    bool held = false;
    for (const auto& entry : scene.forest.update(i == 30).trees) {
      if (entry.tree != 0) continue;
      held = !entry.promoted.empty();
      EXPECT_EQ(entry.modal.amplitude.empty(), i < 30) << i;
    }
    EXPECT_TRUE(held) << i;
  }
}

// Displays pose such a tree in single precision, within the tolerance of the batched path.
TEST(ModalTreeState, BatchedPoseIsThePlainOne) {
  Clearing scene;
  scene.run(3.0);
  const Tree tree = scene.tree(0);
  const Nanoseconds stamp = scene.now() + seconds(0.01);
  const auto plain = scene.forest.poseForSensors(tree, 0, stamp);
  BatchPoses fast;
  ASSERT_NE(scene.forest.sensed().modes.find(0), nullptr);
  scene.forest.sensed().modes.find(0)->pose(BatchPoser(tree), stamp, fast);
  for (std::size_t b = 0; b < plain.size(); ++b)
    ASSERT_LT(length(plain[b].position - fast.at(static_cast<int>(b)).position),
              1e-5 * tree.skeleton.height);
}

}  // namespace
}  // namespace vegetation_sim::forest

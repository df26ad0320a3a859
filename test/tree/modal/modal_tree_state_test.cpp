// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/modal/modal_tree_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

// N13: near trees get modes when the tolerance requires it, and lose them afterwards.
TEST(ModalTreeState, NearTreesHaveModesAndFarOnesHaveNone) {
  Clearing scene(breeze(), 0.1);
  scene.run(2.0);
  EXPECT_EQ(scene.forest.sensed().modes.modalStates().size(), 4u);
  for (std::uint32_t id = 0; id < 4; ++id)
    EXPECT_EQ(scene.forest.sensed().levels.of(id).level, MODAL_LEVEL) << id;
  scene.look(false);
  scene.run(0.5);
  EXPECT_EQ(scene.forest.sensed().modes.modalStates().size(), 4u);  // they still fade
  scene.run(1.0);
  EXPECT_TRUE(scene.forest.sensed().modes.modalStates().empty());
}

// Steady wind needs no modes, and without a budget there are none.
TEST(ModalTreeState, TreesWithoutNeedHaveNoModes) {
  Clearing steady(wind::Field({makeDisk(1, Vec3::Zero(), 2000.0, Vec3(5, 1, 0))}));
  steady.run(1.0);
  EXPECT_TRUE(steady.forest.sensed().modes.modalStates().empty());
  wind::Primitive trace = makeBreeze(2, Vec3(1e-6, 0.0, 0.0));
  Clearing besides(wind::Field({makeDisk(1, Vec3::Zero(), 2000.0, Vec3(5, 1, 0)), trace}));
  besides.run(1.0);
  EXPECT_TRUE(besides.forest.sensed().modes.modalStates().empty());
  Clearing poor;
  poor.settings.budget.modal_trees = 0;
  poor.use();
  poor.run(1.0);
  EXPECT_TRUE(poor.forest.sensed().modes.modalStates().empty());
  EXPECT_GT(poor.forest.sensed().levels.of(0).level, 0);
}

// A disk requests no modes, and takes none from trees that it does not reach: the error of these in
// the breeze, bending included, is still compared with the tolerance.
TEST(ModalTreeState, ADiscFarAwayTakesNoModes) {
  wind::Primitive steady = makeBreeze(1, Vec3(15.0, 3.0, 0.0));
  steady.turbulence = 0.02;
  const wind::Primitive far = makeDisk(2, Vec3(3000.0, 0.0, 0.0), 5.0, Vec3(5, 1, 0));
  Clearing alone(wind::Field({steady}, 3)), beside(wind::Field({steady, far}, 3));
  int modal = 0, plain = 0;
  for (double tolerance = 0.5; tolerance < 200.0; tolerance *= 1.2) {
    for (Clearing* scene : {&alone, &beside}) {
      scene->tolerate(tolerance);
      scene->advance();
    }
    ASSERT_EQ(alone.forest.sensorChoice().plants().size(),
              beside.forest.sensorChoice().plants().size());
    for (std::size_t i = 0; i < alone.forest.sensorChoice().plants().size(); ++i) {
      const int wanted = alone.forest.sensorChoice().plants()[i].wanted;
      EXPECT_EQ(beside.forest.sensorChoice().plants()[i].wanted, wanted) << i << " " << tolerance;
      ++(wanted >= MODAL_LEVEL ? modal : plain);
    }
  }
  EXPECT_GT(modal, 0);
  EXPECT_GT(plain, 0);
}

// The memory of a tree is counted, with the table of the breeze's waves.
TEST(ModalTreeState, CountsWhatItKeepsOfTheWaves) {
  const auto bytes = [](const wind::Field& field) {
    Clearing scene(field, 0.1);
    scene.run(1.0);
    EXPECT_FALSE(scene.forest.sensed().modes.modalStates().empty());
    return scene.forest.sensed().modes.bytes() / scene.forest.sensed().modes.modalStates().size();
  };
  const wind::Primitive first = makeBreeze(1, Vec3(5.0, 1.0, 0.0));
  const wind::Primitive second = makeBreeze(2, Vec3(4.0, 1.0, 0.0));
  const std::size_t one = bytes(wind::Field({first}, 3)),
                    two = bytes(wind::Field({first, second}, 3));
  EXPECT_GE(two, one + 24 * 6 * 20 * sizeof(double));  // waves, loads of each, oscillators
}

// N13: beyond MODAL_LIMIT the forest reports it, predicts a larger error and saturates: no joint
// exceeds its limit in any storm. Below the limit none of this happens.
TEST(ModalTreeState, SaturatesAndSaysSoBeyondTheLimit) {
  double share[2];
  for (const bool storm : {false, true}) {
    Clearing scene(wind::Field({makeBreeze(1, Vec3(storm ? 90.0 : 5.0, 1.0, 0.0))}, 3), 0.1);
    scene.run(3.0);
    ASSERT_EQ(scene.forest.sensed().modes.modalStates().size(), 4u);
    double bend = 0.0, turn = 0.0;
    for (int i = 0; i < TICK_RATE; ++i) {
      scene.advance();
      const ModalTreeState& birch = *scene.forest.sensed().modes.find(2);
      turn = std::max(turn, birch.modes().probe().largestTurn(birch.state().amplitude));
      for (const JointAngles& joint : scene.angles(scene.tree(2), 2, scene.now()))
        bend = std::max(bend, difference(joint, {}));
      EXPECT_EQ(scene.forest.sensorChoice().figures().strained > 0, storm);
    }
    EXPECT_EQ(turn > physics::MODAL_LIMIT, storm) << turn;
    EXPECT_LE(bend, BEND_LIMIT);
    for (const Plant& plant : scene.forest.sensorChoice().plants())
      if (plant.id == 2) share[storm] = plant.error[MODAL_LEVEL] / plant.error[0];
  }
  EXPECT_GT(share[1], share[0] + 0.1);
}

// N13, S1-24: the motion is continuous. At every tick, the visible motion before and after it
// agrees within 0.1 degree, and its rates within 1 % of the largest rate.
TEST(ModalTreeState, NothingJumpsGoingUpOrDown) {
  Clearing scene;
  const Tree tree = scene.tree(0);
  const Nanoseconds aside = seconds(1e-4);
  double jump = 0.0, kick = 0.0, peak = 0.0;
  for (int i = 0; i < 4 * TICK_RATE; ++i) {
    if (i == 2 * TICK_RATE) scene.look(false);
    const Nanoseconds next = scene.grid.timeOf(scene.tick + 1);
    const auto early = scene.angles(tree, 0, next - aside), before = scene.angles(tree, 0, next);
    scene.advance();
    const auto after = scene.angles(tree, 0, next), late = scene.angles(tree, 0, next + aside);
    for (std::size_t b = 0; b < before.size(); ++b) {
      jump = std::max(jump, difference(before[b], after[b]));
      const JointAngles in{before[b].first - early[b].first, before[b].second - early[b].second};
      const JointAngles out{late[b].first - after[b].first, late[b].second - after[b].second};
      kick = std::max(kick, difference(in, out) / 1e-4);
      peak = std::max(peak, difference(out, {}) / 1e-4);
    }
  }
  std::printf("largest jump %.1e rad, in rate %.1e of %.2f rad/s\n", jump, kick, peak);
  EXPECT_LT(jump, 0.1 / 57.3);
  EXPECT_LT(kick, 0.01 * peak);
}

// N6: a restored forest moves as the one that continued.
TEST(ModalTreeState, IsSavedRestoredAndHashed) {
  Clearing scene;
  scene.requireOfTheWorld();
  scene.run(1.0);
  const ForestSnapshot saved = scene.forest.snapshot();
  const std::int64_t tick = scene.tick;
  scene.run(1.0);
  const std::uint64_t hash = scene.forest.hash();
  scene.forest.restore(saved);
  EXPECT_NE(scene.forest.hash(), hash);
  scene.tick = tick;
  scene.run(1.0);
  EXPECT_EQ(scene.forest.hash(), hash);
}

// N13, N10: physics starts from the modal angles and rates with compensation, and moves as the
// modes while motion is small.
TEST(ModalTreeState, HandsOverToPhysicsWithCompensation) {
  Clearing scene;
  scene.requireOfTheWorld();
  PhysicsSettings physics;
  physics.promotion = Promotion::DEPTH;
  scene.forest.setPhysics(physics);
  scene.run(3.0);
  const Tree tree = scene.tree(0);
  const auto before = scene.angles(tree, 0, scene.now());
  Push touch;
  touch.point = {0, static_cast<int>(tree.skeleton.branches.size()) - 1, 0.0};
  touch.until = scene.now() + seconds(1.0);
  scene.forest.push(touch);
  double off = 0.0, size = 0.0;
  for (int i = 0; i < TICK_RATE; ++i) {
    scene.advance();
    const PromotedTree promoted = scene.forest.promoted(0);
    ASSERT_FALSE(promoted.branches.empty());
    if (i == 0) {
      for (const SubtreeJoint& joint : scene.forest.snapshot().physics.subtrees().at(0).joints())
        ASSERT_EQ(joint.compensation, 1.0);
      for (const PromotedBranch& b : promoted.branches)
        EXPECT_LT(difference(b.q, before[static_cast<std::size_t>(b.branch)]), 0.05);
    }
    std::vector<JointAngles> modal = scene.forest.sensed().modes.find(0)->modes().bendsOf(
        scene.forest.sensed().modes.find(0)->amplitudeAt(scene.now()));
    std::vector<JointAngles> real = modal;
    overlay(promoted, scene.now(), real);
    const std::vector<Pose> a = forwardKinematics(tree, modal), b = forwardKinematics(tree, real);
    for (std::size_t j = 0; j < a.size(); ++j) {
      off += (a[j].position - b[j].position).squaredNorm();
      size += (a[j].position - tree.skeleton.branches[j].rest.position).squaredNorm();
    }
  }
  std::printf("a second of physics: %.1f %% off the modes\n", 100.0 * std::sqrt(off / size));
  EXPECT_LT(std::sqrt(off / size), 0.1);
}

}  // namespace
}  // namespace vegetation_sim::forest

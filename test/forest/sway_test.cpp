// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/sway.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

wind::Field breeze() {
  return wind::Field({makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3);
}

/// Four trees in a breeze, and an eye that comes and goes.
struct Clearing {
  explicit Clearing(const wind::Field& field = breeze()) {
    forest.setWind(field);
    look(true);
  }
  void look(bool near) {
    eye.id = "eye";
    eye.eye.position = near ? Vec3(6.0, 6.0, 3.0) : Vec3(4000.0, 0.0, 3.0);
  }
  Nanoseconds now() const { return grid.timeOf(tick); }
  void advance() {
    eye.stamp = grid.timeOf(++tick);
    forest.setViewer(eye);
    forest.advance(now());
  }
  void run(double duration) {
    for (int i = 0; i < static_cast<int>(duration * TICK_RATE + 0.5); ++i) advance();
  }
  Tree tree(std::uint32_t id) const { return growTree(forest.layout(), id, forest.terrain()); }
  std::vector<JointAngles> angles(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
    std::vector<JointAngles> out =
        swayingAngles(tree, forest.memory().wind.at(stamp).relativeTo(tree.foot),
                      weightsAt(forest.memory().levels.of(id), stamp, forest.layout().motion),
                      forest.sway(id), stamp);
    overlay(forest.promoted(id), stamp, out);
    return out;
  }

  Forest forest{gridLayout(2, 12.0), flatTerrain(), Settings()};
  Viewer eye;
  TickGrid grid{TICK_RATE};
  std::int64_t tick{TickGrid(TICK_RATE).tickAt(PHYSICS_START)};
};

// N13: near trees get their modes when the tolerance asks for it, and lose them after.
TEST(Sway, NearTreesHaveModesAndFarOnesHaveNone) {
  Clearing scene;
  Settings settings;
  settings.tolerance = 0.1;
  scene.forest.setSettings(settings);
  scene.run(2.0);
  EXPECT_EQ(scene.forest.memory().modes.sways().size(), 4u);
  for (std::uint32_t id = 0; id < 4; ++id)
    EXPECT_EQ(scene.forest.memory().levels.of(id).level, MODAL_LEVEL) << id;
  scene.look(false);
  scene.run(0.5);
  EXPECT_EQ(scene.forest.memory().modes.sways().size(), 4u);  // they still fade
  scene.run(1.0);
  EXPECT_TRUE(scene.forest.memory().modes.sways().empty());
}

// Steady wind has no lag to show, and no budget has no modes.
TEST(Sway, NoTreeHasModesThatNobodyAskedFor) {
  Clearing steady(wind::Field({makeDisk(1, Vec3::Zero(), 2000.0, Vec3(5, 1, 0))}));
  steady.run(1.0);
  EXPECT_TRUE(steady.forest.memory().modes.sways().empty());
  wind::Primitive trace = makeBreeze(2, Vec3(1e-6, 0.0, 0.0));
  Clearing besides(wind::Field({makeDisk(1, Vec3::Zero(), 2000.0, Vec3(5, 1, 0)), trace}));
  besides.run(1.0);
  EXPECT_TRUE(besides.forest.memory().modes.sways().empty());
  Clearing poor;
  Settings settings;
  settings.budget.modal_trees = 0;
  poor.forest.setSettings(settings);
  poor.run(1.0);
  EXPECT_TRUE(poor.forest.memory().modes.sways().empty());
  EXPECT_GT(poor.forest.memory().levels.of(0).level, 0);
}

// A disc asks for no modes, and takes none from trees that it does not reach: what the breeze does
// to these, bending included, goes on to be held against the tolerance.
TEST(Sway, ADiscFarAwayTakesNoModes) {
  wind::Primitive steady = makeBreeze(1, Vec3(15.0, 3.0, 0.0));
  steady.turbulence = 0.02;
  const wind::Primitive far = makeDisk(2, Vec3(3000.0, 0.0, 0.0), 5.0, Vec3(5, 1, 0));
  Clearing alone(wind::Field({steady}, 3)), beside(wind::Field({steady, far}, 3));
  int modal = 0, plain = 0;
  for (double tolerance = 0.5; tolerance < 200.0; tolerance *= 1.2) {
    Settings settings;
    settings.tolerance = tolerance;
    for (Clearing* scene : {&alone, &beside}) {
      scene->forest.setSettings(settings);
      scene->advance();
    }
    ASSERT_EQ(alone.forest.plants().size(), beside.forest.plants().size());
    for (std::size_t i = 0; i < alone.forest.plants().size(); ++i) {
      const int wanted = alone.forest.plants()[i].wanted;
      EXPECT_EQ(beside.forest.plants()[i].wanted, wanted) << i << " " << tolerance;
      ++(wanted >= MODAL_LEVEL ? modal : plain);
    }
  }
  EXPECT_GT(modal, 0);
  EXPECT_GT(plain, 0);
}

// What is kept for a tree is counted, the table of the breeze's waves too.
TEST(Sway, CountsWhatItKeepsOfTheWaves) {
  const auto bytes = [](const wind::Field& field) {
    Clearing scene(field);
    Settings settings;
    settings.tolerance = 0.1;
    scene.forest.setSettings(settings);
    scene.run(1.0);
    EXPECT_FALSE(scene.forest.memory().modes.sways().empty());
    return scene.forest.memory().modes.bytes() / scene.forest.memory().modes.sways().size();
  };
  const wind::Primitive first = makeBreeze(1, Vec3(5.0, 1.0, 0.0));
  const wind::Primitive second = makeBreeze(2, Vec3(4.0, 1.0, 0.0));
  const std::size_t one = bytes(wind::Field({first}, 3)),
                    two = bytes(wind::Field({first, second}, 3));
  EXPECT_GE(two, one + 24 * 6 * 20 * sizeof(double));  // waves, loads of each, oscillators
}

// N13: beyond MODAL_LIMIT the forest says so, predicts so much more error, and saturates: no joint
// passes its limit in any storm. Below, nothing of it.
TEST(Sway, SaturatesAndSaysSoBeyondTheLimit) {
  double share[2];
  for (const bool storm : {false, true}) {
    Clearing scene(wind::Field({makeBreeze(1, Vec3(storm ? 90.0 : 5.0, 1.0, 0.0))}, 3));
    Settings settings;
    settings.tolerance = 0.1;
    scene.forest.setSettings(settings);
    scene.run(3.0);
    ASSERT_EQ(scene.forest.memory().modes.sways().size(), 4u);
    double bend = 0.0, turn = 0.0;
    for (int i = 0; i < TICK_RATE; ++i) {
      scene.advance();
      const Sway& birch = *scene.forest.sway(2);
      turn = std::max(turn, birch.modes().probe().largestTurn(birch.state().amplitude));
      for (const JointAngles& joint : scene.angles(scene.tree(2), 2, scene.now()))
        bend = std::max(bend, difference(joint, {}));
      EXPECT_EQ(scene.forest.governor().strained > 0, storm);
    }
    EXPECT_EQ(turn > physics::MODAL_LIMIT, storm) << turn;
    EXPECT_LE(bend, BEND_LIMIT);
    for (const Plant& plant : scene.forest.plants())
      if (plant.id == 2) share[storm] = plant.error[MODAL_LEVEL] / plant.error[0];
  }
  EXPECT_GT(share[1], share[0] + 0.1);
}

// N13, S1-24: no pop. At every tick, what was seen up to it and what is seen from it on agree
// within 0.1 degree, and their rates within 1 % of the largest rate.
TEST(Sway, NothingJumpsGoingUpOrDown) {
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

// N13: key frames tell amplitudes; between them a replica steps the modes itself. Whoever comes
// late and whoever was there from the beginning pose every branch as the forest does, to the bit.
TEST(Sway, ReplicasSwayToTheBit) {
  Clearing scene;
  Settings settings;
  settings.budget.state_bytes = 1600;  // for plain modes, which are found at once
  scene.forest.setSettings(settings);
  ForestReplica steady, late;
  for (ForestReplica* replica : {&steady, &late}) {
    replica->setLayout(scene.forest.layout(), flatTerrain());
    replica->setWind(breeze());
  }
  const Tree tree = scene.tree(2);
  std::size_t told = 0;
  for (int i = 0; i < 3 * TICK_RATE; ++i) {
    if (i == 2 * TICK_RATE - 20) scene.look(false);
    scene.advance();
    const StateUpdate update = scene.forest.update(i % TICK_RATE == 0);
    for (const auto& entry : update.trees) told += !entry.sway.amplitude.empty();
    ASSERT_TRUE(steady.apply(update)) << steady.why();
    const bool joined = i >= TICK_RATE;
    ASSERT_EQ(joined && late.apply(update), joined) << late.why();
    if (i % 7 && i % TICK_RATE) continue;  // key frames too: ahead of those too they are alike
    const Nanoseconds stamp = scene.now() + seconds(0.005);
    const auto here = scene.forest.pose(tree, 2, stamp);
    for (const ForestReplica* replica : {&steady, &late}) {
      if (replica == &late && !joined) continue;
      const auto there = replica->pose(tree, 2, stamp);
      for (std::size_t b = 0; b < here.size(); ++b) {
        ASSERT_EQ(here[b].position, there[b].position) << i << " " << b;
        ASSERT_EQ(here[b].orientation.w, there[b].orientation.w) << i << " " << b;
      }
    }
  }
  // Of 3 s at 60 Hz: 180 would be if every tick told.
  EXPECT_LT(told, 4u * 15u);
}

// N13: who joins late finds fine modes one by one, not all at once: ticks would be dropped. The
// trees that wait are shown procedural, and all are to the bit in the end.
TEST(Sway, WhoJoinsLateFindsFineModesOneByOne) {
  Clearing scene;
  Settings settings;
  settings.tolerance = 0.05;
  scene.forest.setSettings(settings);
  scene.run(2.0);
  for (std::uint32_t id = 0; id < 4; ++id) {
    ASSERT_NE(scene.forest.sway(id), nullptr) << id;
    ASSERT_TRUE(scene.forest.sway(id)->fine()) << id;
  }
  ForestReplica late;
  late.setLayout(scene.forest.layout(), flatTerrain());
  late.setWind(breeze());
  for (int i = 0; i <= TICK_RATE; ++i) {
    scene.advance();
    ASSERT_TRUE(late.apply(scene.forest.update(i % TICK_RATE == 0))) << late.why();
    int found = 0;
    for (std::uint32_t id = 0; id < 4; ++id) found += late.sway(id) != nullptr;
    EXPECT_EQ(found, i < TICK_RATE ? 1 : 4) << i;
  }
  for (std::uint32_t id = 0; id < 4; ++id) {
    const Tree tree = scene.tree(id);
    const auto here = scene.forest.pose(tree, id, scene.now()),
               there = late.pose(tree, id, scene.now());
    for (std::size_t b = 0; b < here.size(); ++b) ASSERT_EQ(here[b].position, there[b].position);
  }
}

// N13: modes that are found before they are told of are counted, and neither they nor the wish for
// them outlive what they are for.
TEST(ForestModes, WhatIsAwaitedIsCountedAndDropped) {
  const Layout layout = gridLayout(2, 12.0);
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  const Grounds at{layout, flat, wind};
  LevelMap modal, still;
  for (std::uint32_t id = 0; id < 4; ++id) modal.set(id, LevelState::settled(MODAL_LEVEL));
  ForestModes source;
  for (const std::uint32_t id : {0u, 1u}) source.begin(at, id, true, seconds(1.0));
  const std::size_t all = source.find(1)->modes().size();
  ForestModes modes;
  modes.begin(at, 0, false, seconds(1.0));
  for (const std::uint32_t id : {0u, 1u, 2u}) modes.await(id);
  EXPECT_EQ(modes.find(0), nullptr);  // what it had would be stale
  EXPECT_EQ(modes.bytes(), 0u);
  modes.restore(at, 0, source.find(0)->state(), seconds(1.0));  // no longer awaited
  const std::size_t one = modes.bytes();
  modes.prepareNext(at);
  EXPECT_FALSE(modes.isReady(2, all));
  EXPECT_TRUE(modes.isReady(1, all));
  EXPECT_GT(modes.bytes(), one);
  modes.settle(modal, seconds(1.0), 1.0);
  EXPECT_TRUE(modes.isReady(1, all));
  modes.settle(still, seconds(1.0), 1.0);
  EXPECT_FALSE(modes.isReady(1, all));
  modes.prepareNext(at);  // of no tree: 2 has left modes
  EXPECT_EQ(modes.bytes(), 0u);
}

// N13: who was told of plain modes, lost messages and is told of fine ones at a key frame does not
// go on from the old ones, over steps as long as what was lost.
TEST(Sway, NothingStaleIsShownWhileFineModesAreAwaited) {
  Clearing scene;
  Settings settings;
  settings.tolerance = 0.05;
  settings.budget.state_bytes = 1600;  // for plain modes
  scene.forest.setSettings(settings);
  scene.run(2.0);
  ForestReplica replica;
  replica.setLayout(scene.forest.layout(), flatTerrain());
  replica.setWind(breeze());
  ASSERT_TRUE(replica.apply(scene.forest.update(true)));
  for (std::uint32_t id = 0; id < 4; ++id) ASSERT_NE(replica.sway(id), nullptr);
  settings.budget.state_bytes = 1000000;
  scene.forest.setSettings(settings);
  scene.run(2.0);  // of which nothing is told
  for (std::uint32_t id = 0; id < 4; ++id) ASSERT_TRUE(scene.forest.sway(id)->fine()) << id;
  for (int i = 0; i < 5; ++i) {
    scene.advance();
    ASSERT_TRUE(replica.apply(scene.forest.update(i == 0))) << replica.why();
    int shown = 0;
    for (std::uint32_t id = 0; id < 4; ++id) {
      if (!replica.sway(id)) continue;
      ++shown;
      EXPECT_TRUE(replica.sway(id)->fine()) << id;
      EXPECT_EQ(replica.sway(id)->state().amplitude, scene.forest.sway(id)->state().amplitude);
    }
    EXPECT_EQ(shown, 1);
  }
}

// N13: a tree that stands at another stamp starts again on its procedural motion.
TEST(ForestModes, StartAgainWhatStandsAtAnotherStamp) {
  const Layout layout = gridLayout(2, 12.0);
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  const Grounds at{layout, flat, wind};
  ForestModes early, late;
  early.begin(at, 0, false, seconds(1.0));
  late.begin(at, 0, false, seconds(9.0));
  early.advance(wind, seconds(8.9), seconds(9.0));
  EXPECT_EQ(early.find(0)->stamp(), seconds(9.0));
  EXPECT_EQ(early.find(0)->state().amplitude, late.find(0)->state().amplitude);
}

// N13: levers that turn feed back on what turns them; however strong the storm and long the tick,
// the tree stays near where levers at rest have it.
TEST(Sway, LeversThatTurnStayBoundedInStormsOverLongTicks) {
  const Layout layout = gridLayout(2, 12.0);
  std::vector<wind::Primitive> three;
  for (std::uint32_t id = 1; id <= 3; ++id) three.push_back(makeBreeze(id, Vec3(90.0, 10.0, 0.0)));
  const wind::Field storm(three, 3);
  const auto largestTurn = [](const Sway& sway) {
    return sway.modes().probe().largestTurn(sway.state().amplitude);
  };
  for (std::uint32_t id = 0; id < 4; ++id) {
    const Tree tree = growTree(layout, id, terrain::HeightMap());
    const auto modes =
        std::make_shared<const ModalTree>(tree, layout.species[tree.seed.species], FINE_MODES);
    for (const int steps : {1, 6, 60}) {  // of 1/60 s a tick
      Sway turning(modes), stiff(modes);
      std::vector<ModalLoad> loads(static_cast<std::size_t>(steps) + 1), rest;
      double most = 0.0, least = 0.0;
      for (int tick = 0; tick * steps < 20 * 60; ++tick) {
        const auto stamp = [&](int i) { return seconds(100.0 + (tick * steps + i) / 60.0); };
        for (int i = 0; i <= steps; ++i)
          turning.loadOf(storm.at(stamp(i)), loads[static_cast<std::size_t>(i)]);
        rest = loads;
        for (ModalLoad& load : rest) load.air.setZero();
        for (Sway* sway : {&turning, &stiff}) {
          const std::vector<ModalLoad>& of = sway == &turning ? loads : rest;
          if (tick == 0) sway->restore(sway->state(), of[0], stamp(0));
          sway->step(of, stamp(steps));
        }
        most = std::max(most, largestTurn(turning));
        least = std::max(least, largestTurn(stiff));
      }
      std::printf("tree %u, ticks of %d/60 s: %.2f rad, %.2f with levers at rest\n", id, steps,
                  most, least);
      EXPECT_LT(most, 1.5 * least) << id << " " << steps;
    }
  }
}

// What a hand moves is told at every tick, the amplitudes of the tree it is on are not.
TEST(Sway, AHeldTreeTellsItsAmplitudesInKeyFramesOnly) {
  Clearing scene;
  Settings settings;
  settings.tolerance = 0.1;
  scene.forest.setSettings(settings);
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
      EXPECT_EQ(entry.sway.amplitude.empty(), i < 30) << i;
    }
    EXPECT_TRUE(held) << i;
  }
}

// N7, N13: a tree whose modes leave too much goes on in fine ones. Nothing jumps, and a replica
// that was told poses it to the bit.
TEST(Sway, GoesOnInFineModesWithoutAJump) {
  Clearing probe;
  probe.advance();
  const Plant& near = probe.forest.plants().front();
  ASSERT_EQ(near.id, 0u);
  const float plain = near.error[MODAL_LEVEL], fine = near.error[FINE_RUNG];
  ASSERT_LT(fine, 0.8f * plain);
  Clearing scene;
  ForestReplica replica;
  replica.setLayout(scene.forest.layout(), flatTerrain());
  replica.setWind(breeze());
  const Tree tree = scene.tree(0);
  double jump = 0.0, peak = 0.0;
  for (int i = 0; i < 3 * TICK_RATE; ++i) {
    Settings settings;
    settings.tolerance = (i < 2 * TICK_RATE ? 1.1 : 0.9) * static_cast<double>(plain);
    scene.forest.setSettings(settings);
    const auto before = scene.angles(tree, 0, scene.grid.timeOf(scene.tick + 1));
    scene.advance();
    ASSERT_TRUE(replica.apply(scene.forest.update(i % TICK_RATE == 0))) << replica.why();
    const auto after = scene.angles(tree, 0, scene.now());
    const auto here = scene.forest.pose(tree, 0, scene.now()),
               there = replica.pose(tree, 0, scene.now());
    for (std::size_t b = 0; b < after.size(); ++b) {
      jump = std::max(jump, difference(before[b], after[b]));
      peak = std::max(peak, difference(after[b], {}));
      ASSERT_EQ(here[b].position, there[b].position) << i << " " << b;
    }
    if (i == 2 * TICK_RATE - 1) {
      ASSERT_NE(scene.forest.sway(0), nullptr);
      EXPECT_FALSE(scene.forest.sway(0)->fine());
    }
  }
  EXPECT_TRUE(scene.forest.sway(0)->fine());
  std::printf("largest jump %.1e rad of %.2f\n", jump, peak);
  EXPECT_LT(jump, 0.1 / 57.3);
}

// N7: who loses fine modes because bytes are short gets plain ones once those have faded, and keeps
// them: no rung changes more than once a second, and what is told is short.
TEST(Sway, FineModesThatAreLostDoNotFlicker) {
  Clearing scene;
  scene.advance();
  Settings settings;
  settings.tolerance = 0.9 * static_cast<double>(scene.forest.plants().front().error[MODAL_LEVEL]);
  scene.forest.setSettings(settings);
  scene.run(2.0);
  ASSERT_NE(scene.forest.sway(0), nullptr);
  ASSERT_TRUE(scene.forest.sway(0)->fine());
  settings.budget.state_bytes = 500;
  scene.forest.setSettings(settings);
  std::map<std::uint32_t, int> changes, told;
  for (int i = 0; i < 5 * TICK_RATE; ++i) {
    const LevelMap before = scene.forest.memory().levels;
    scene.advance();
    for (std::uint32_t tree = 0; tree < 4; ++tree)
      changes[tree] += scene.forest.memory().levels.of(tree).level != before.of(tree).level;
    for (const auto& entry : scene.forest.update(false).trees)
      told[entry.tree] += !entry.sway.amplitude.empty();
  }
  for (std::uint32_t tree = 0; tree < 4; ++tree) {
    EXPECT_LE(changes[tree], 2) << tree;  // to its stair, to plain modes
    EXPECT_LE(told[tree], 3) << tree;
  }
  ASSERT_EQ(scene.forest.memory().modes.sways().size(), 1u);  // whom the bytes suffice for
  EXPECT_FALSE(scene.forest.memory().modes.sways().begin()->second.fine());
}

// N13: a tree of few branches has all of its modes at once; they are not looked for again, and
// whoever is told of them has the same.
TEST(Sway, TreesOfFewBranchesHaveAllOfTheirModes) {
  const wind::Field wind = breeze();
  const terrain::HeightMap flat;
  for (const int branches : {1, 4, 8, 10, 11, 12, 15}) {
    Layout layout = gridLayout(1, 1.0);
    layout.species[0] = Species();
    layout.species[0].limbs[0].segments = branches;
    layout.species[0].limbs[0].leaves = 20.0;
    const Grounds at{layout, flat, wind};
    ForestModes modes, late;
    modes.begin(at, 0, false, seconds(1.0));
    EXPECT_EQ(modes.find(0)->fine(), branches <= 11) << branches;
    modes.begin(at, 0, true, seconds(1.0));
    const Sway& here = *modes.find(0);
    EXPECT_TRUE(here.fine()) << branches;
    const ModalTree* found = &here.modes();
    modes.begin(at, 0, true, seconds(1.0));
    EXPECT_EQ(&modes.find(0)->modes(), found) << branches;
    late.restore(at, 0, here.state(), here.stamp());
    const auto right = here.modes().bendsOf(here.state().amplitude);
    const auto there = late.find(0)->modes().bendsOf(here.state().amplitude);
    ASSERT_EQ(right.size(), static_cast<std::size_t>(branches));
    for (std::size_t b = 0; b < right.size(); ++b) {
      EXPECT_EQ(right[b].first, there[b].first) << branches;
      EXPECT_EQ(right[b].second, there[b].second) << branches;
    }
  }
}

// Displays pose such a tree in single precision: within the bar of the batched path.
TEST(Sway, BatchedPoseIsThePlainOne) {
  Clearing scene;
  scene.run(3.0);
  const Tree tree = scene.tree(0);
  const Nanoseconds stamp = scene.now() + seconds(0.01);
  const auto plain = scene.forest.pose(tree, 0, stamp);
  BatchPoses fast;
  ASSERT_NE(scene.forest.sway(0), nullptr);
  scene.forest.sway(0)->pose(BatchPoser(tree), stamp, fast);
  for (std::size_t b = 0; b < plain.size(); ++b)
    ASSERT_LT(length(plain[b].position - fast.at(static_cast<int>(b)).position),
              1e-5 * tree.skeleton.height);
}

// N6: what is restored sways as what went on.
TEST(Sway, IsSavedRestoredAndHashed) {
  Clearing scene;
  scene.run(1.0);
  const ForestMemory saved = scene.forest.memory();
  const std::int64_t tick = scene.tick;
  scene.run(1.0);
  const std::uint64_t hash = scene.forest.hash();
  scene.forest.restore(saved);
  EXPECT_NE(scene.forest.hash(), hash);
  scene.tick = tick;
  scene.run(1.0);
  EXPECT_EQ(scene.forest.hash(), hash);
}

// N13: physics starts from the modal angles and rates, without compensation, and goes on as the
// modes do while motion is small.
TEST(Sway, HandsOverToPhysicsWithoutCompensation) {
  Clearing scene;
  PhysicsSettings physics;
  physics.promotion = static_cast<int>(Promotion::DEPTH);
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
      for (const PartJoint& joint : scene.forest.memory().physics.parts().at(0).joints())
        ASSERT_EQ(joint.compensation, 0.0);
      for (const PromotedBranch& b : promoted.branches)
        EXPECT_LT(difference(b.q, before[static_cast<std::size_t>(b.branch)]), 0.05);
    }
    std::vector<JointAngles> modal =
        scene.forest.sway(0)->modes().bendsOf(scene.forest.sway(0)->amplitudeAt(scene.now()));
    std::vector<JointAngles> real = modal;
    overlay(promoted, scene.now(), real);
    const std::vector<Pose> a = forwardKinematics(tree, modal), b = forwardKinematics(tree, real);
    for (std::size_t j = 0; j < a.size(); ++j) {
      off += (a[j].position - b[j].position).squaredNorm();
      size += (a[j].position - tree.skeleton.branches[j].rest.position).squaredNorm();
    }
  }
  std::printf("a second of physics without compensation: %.1f %% off the modes\n",
              100.0 * std::sqrt(off / size));
  EXPECT_LT(std::sqrt(off / size), 0.1);
}

}  // namespace
}  // namespace vegetation_sim::forest

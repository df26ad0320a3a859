// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Branches that break, and what replicas know of trees that have lost some.
#include <gtest/gtest.h>

#include "core/error_text.h"
#include "scenes/forest/modal_forest_scene.h"
#include "tree/growth/broken_branch.h"

namespace vegetation_sim::forest {
namespace {

constexpr double STRENGTH = 5e7;  // [Pa]

/// One trunk of equal segments and constant radius, which stands on a foot that cannot break: a
/// cantilever from the end of the foot on.
struct Cantilever {
  static constexpr int SEGMENTS = 16;
  PhysicsRig rig;
  double length, radius;

  static Layout layout(double slenderness, double strength) {
    Layout out = gridLayout(1, 12.0);
    Species species;
    species.name = "pole";
    species.trunk_radius = 0.02;
    species.twig_radius = 0.001;
    species.height = slenderness * species.trunk_radius * SEGMENTS / (SEGMENTS - 1.0);
    species.height_variation = species.lean = species.noise = 0.0;
    species.slenderness = 5000.0;
    species.strength = strength;
    species.drag_coefficient = 0.0;
    LimbRule trunk;
    trunk.segments = SEGMENTS;
    trunk.taper = 1.0;
    trunk.wander = 0.0;
    species.limbs = {trunk};
    out.species = {species};
    for (TreeSeed& seed : out.trees) seed.species = 0;
    return out;
  }
  explicit Cantilever(double slenderness, double strength = STRENGTH, int threads = 1)
      : rig(layout(slenderness, strength)) {
    rig.forest.setThreads(threads);
    radius = rig.branches()[1].base_radius;
    length = 0.0;
    for (std::size_t i = 1; i < rig.branches().size(); ++i) length += rig.branches()[i].length;
  }

  // Pulls the tip sideways, slowly, until something breaks. Returns the last force before [N], as
  // far as it acts across the foot.
  double pullUntilItBreaks() {
    Grab grab = rig.grabOf(SEGMENTS - 1);
    grab.stiffness = 1e5;
    grab.damping = 500.0;
    grab.force_limit = 1e5;
    const Vec3 start = grab.target;
    const std::uint32_t id = rig.forest.addGrab(grab);
    double force = 0.0;
    for (int i = 0; i < 120 * TICK_RATE && rig.forest.breaks().empty(); ++i) {
      for (const Reaction& reaction : rig.forest.reactions())
        if (reaction.grab == id) force = std::fabs(reaction.force.x());
      if (rig.forest.grabs().count(id)) {
        const double height = rig.tip(SEGMENTS - 1).z();  // so that the force stays across
        const double way = 0.01 * length * i / TICK_RATE;
        rig.forest.moveGrab(id, Vec3(start.x() + way, start.y(), height));
      }
      rig.advance();
    }
    return force;
  }
};

// Euler and Bernoulli: a bar that is fixed at one end and pulled at the other breaks at its foot,
// when F L = sigma pi r^3 / 4. Tolerance: 5 %; the measured error is the
// shortening of the lever by the deflection, which grows with the slenderness.
TEST(Breaking, CantileverBreaksAtTheForceOfBeamTheory) {
  for (const double slenderness : {20.0, 40.0, 60.0, 90.0}) {
    Cantilever beam(slenderness);
    const double r = beam.radius;
    const double theory = STRENGTH * PI * r * r * r / (4.0 * beam.length);
    const double force = beam.pullUntilItBreaks();
    std::printf("L/r = %.0f: breaks at %.2f N, theory %.2f N, %+.2f %%\n", slenderness, force,
                theory, 100.0 * (force / theory - 1.0));
    ASSERT_EQ(beam.rig.forest.breaks().size(), 1u) << slenderness;
    const Break& broken = beam.rig.forest.breaks().front();
    EXPECT_EQ(broken.piece.branch, 1);
    EXPECT_FALSE(broken.piece.cut);
    EXPECT_GT(broken.stress, STRENGTH);
    EXPECT_LT(broken.stress, 1.02 * STRENGTH);
    EXPECT_NEAR(force / theory, 1.0, 0.05) << slenderness;
  }
}

TEST(Breaking, WoodWithoutAStrengthNeverBreaks) {
  Cantilever beam(40.0, 0.0);
  Grab grab = beam.rig.grabOf(Cantilever::SEGMENTS - 1);
  grab.stiffness = 1e5;
  grab.force_limit = 1e5;
  grab.target += Vec3(0.8 * beam.length, 0.0, -0.5 * beam.length);
  beam.rig.forest.addGrab(grab);
  beam.rig.run(1.0);
  EXPECT_TRUE(beam.rig.forest.broken().empty());
  EXPECT_EQ(beam.rig.forest.grabs().size(), 1u);
}

// At the limit of branches that come off, wood stays and is told.
TEST(Breaking, OverloadedWoodStaysBeyondTheLimitAndIsCounted) {
  constexpr int SIDE = 65;
  Layout layout = Cantilever::layout(40.0, STRENGTH);
  const Layout grid = gridLayout(SIDE, 12.0);
  layout.trees = grid.trees;
  for (TreeSeed& seed : layout.trees) seed.species = 0;
  ASSERT_GT(layout.trees.size(), MOST_BROKEN);
  for (const std::size_t off : {MOST_BROKEN - 1, MOST_BROKEN}) {
    PhysicsRig rig(layout);
    for (std::size_t i = 1; i <= off; ++i)
      rig.forest.cut({static_cast<std::uint32_t>(i), Cantilever::SEGMENTS - 1});
    rig.run(0.1);
    ASSERT_EQ(rig.forest.physicsFigures().broken, off);
    EXPECT_EQ(rig.forest.physicsFigures().unbroken, 0u);
    Grab grab = rig.grabOf(Cantilever::SEGMENTS - 1);
    grab.stiffness = 1e5;
    grab.force_limit = 1e5;
    grab.target += Vec3(0.3, 0.0, -0.2);
    rig.forest.addGrab(grab);
    rig.run(0.5);
    EXPECT_EQ(rig.forest.physicsFigures().broken, MOST_BROKEN) << off;
    EXPECT_EQ(rig.forest.physicsFigures().unbroken, off == MOST_BROKEN ? 1u : 0u);
  }
}

// As they are in every shipped scenario.
TEST(Breaking, BranchesOfShippedTreesBreakWhenPulled) {
  for (const std::string& name : speciesNames()) {
    Layout layout = gridLayout(1, 12.0);
    layout.species = {
        loadSpecies(std::string(PACKAGE_FOLDER) + "/config/species/" + name + ".yaml")};
    PhysicsRig rig(layout);
    rig.run(1.0);
    EXPECT_TRUE(rig.forest.broken().empty()) << name;
    Grab grab = rig.grabOf(static_cast<int>(rig.branches().size()) - 1);
    grab.stiffness = 1e5;
    grab.damping = 500.0;
    grab.force_limit = 1e5;
    grab.target += Vec3(1.0, 0.5, 0.0);
    rig.forest.addGrab(grab);
    rig.run(1.0);
    EXPECT_FALSE(rig.forest.broken().empty()) << name;
  }
}

// A grab reports its force until the tick of the break, and then ends with the reason.
TEST(Breaking, GrabOfABranchThatBreaksEndsWithItsForceAndTheReason) {
  Cantilever beam(40.0);
  ASSERT_GT(beam.pullUntilItBreaks(), 0.0);
  const Forest& forest = beam.rig.forest;
  ASSERT_EQ(forest.breaks().size(), 1u);
  EXPECT_EQ(forest.breaks().front().grabs, std::vector<std::uint32_t>{1});
  ASSERT_EQ(forest.ended().size(), 1u);
  EXPECT_EQ(forest.ended().front().id, 1u);
  EXPECT_EQ(forest.ended().front().reason, EndedGrab::BRANCH_BROKEN);
  EXPECT_TRUE(forest.grabs().empty());
  ASSERT_FALSE(forest.reactions().empty());
  EXPECT_GT(length(forest.reactions().front().force), 1.0);
  EXPECT_GT(forest.breaks().front().mass, 0.0);
}

// The same break, bit by bit, with any number of threads and from a snapshot taken before it.
TEST(Breaking, BreaksAreEqualWithThreadsAndFromASnapshot) {
  Cantilever one(40.0), four(40.0, STRENGTH, 4);
  one.pullUntilItBreaks();
  four.pullUntilItBreaks();
  ASSERT_FALSE(one.rig.forest.broken().empty());
  EXPECT_EQ(one.rig.forest.hash(), four.rig.forest.hash());
  EXPECT_TRUE(one.rig.forest.broken() == four.rig.forest.broken());
  Forest& other = four.rig.forest;
  other.reset();
  other.restore(other.readArchived(one.rig.forest.archived()));
  EXPECT_EQ(one.rig.forest.hash(), other.hash());
  for (int i = 0; i < TICK_RATE; ++i) {
    one.rig.advance();
    other.advance(one.rig.now());
  }
  EXPECT_EQ(one.rig.forest.hash(), other.hash());
}

/// A forest and two replicas; the second only hears key frames.
struct Listeners {
  PhysicsRig rig{{}, 2};
  ForestReplica steady, late;

  Listeners() {
    for (ForestReplica* replica : {&steady, &late}) {
      replica->setLayout(rig.forest.layout(), flatTerrain());
      replica->setWind(rig.forest.snapshot().wind);
    }
    tell(true);
  }
  void setWind(const wind::Field& wind) {
    rig.forest.setWind(wind);
    for (ForestReplica* replica : {&steady, &late}) replica->setWind(wind);
  }
  void tell(bool key_frame) {
    rig.forest.updateView(key_frame);
    const StateUpdate update = rig.forest.update(key_frame);
    EXPECT_TRUE(steady.apply(update)) << steady.why();
    if (!key_frame) return;
    EXPECT_TRUE(late.apply(update)) << late.why();
  }
  void advance(bool key_frame = false) {
    rig.advance();
    tell(key_frame);
  }
  void expectEqual(const ForestReplica& replica) {
    EXPECT_TRUE(replica.broken() == rig.forest.broken());
    for (std::uint32_t id = 0; id < 4; ++id) {
      const Tree there = replica.grow(id);
      const Tree here = growTree(rig.forest.layout(), id, rig.forest.terrain(),
                                 brokenOf(rig.forest.broken(), id));
      ASSERT_EQ(there.skeleton.hash(), here.skeleton.hash());
      const auto a = replica.pose(there, id, rig.now()),
                 b = rig.forest.poseForSensors(here, id, rig.now());
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i].position == b[i].position) << i;
    }
  }
};

// Deltas tell what has come off since the last message, key frames all.
TEST(Cutting, ReplicasAndLateJoinersAgreeWithTheForest) {
  Listeners all;
  all.setWind(steadyWind(Vec3(4.0, 1.0, 0.0)));
  all.advance(true);
  all.rig.forest.cut({0, 5});
  all.advance();
  all.expectEqual(all.steady);
  EXPECT_TRUE(all.late.broken().empty());
  all.rig.forest.cut({2, 7});
  all.advance();
  all.advance();
  all.expectEqual(all.steady);
  all.advance(true);
  all.expectEqual(all.steady);
  all.expectEqual(all.late);
  all.rig.forest.reset();
  all.advance(true);
  EXPECT_TRUE(all.steady.broken().empty());
  all.expectEqual(all.steady);
}

// A tree that has lost a limb swings in its own modes, in the forest as in replicas and after a
// snapshot.
TEST(Cutting, ModesOfATreeFollowItsLoss) {
  Clearing scene;
  ForestReplica replica;
  scene.introduce(replica);
  const auto advance = [&](bool key_frame) {
    scene.advance();
    ASSERT_TRUE(replica.apply(scene.forest.update(key_frame))) << replica.why();
  };
  const auto modal_state = [&] { return scene.forest.sensed().modes.find(0); };
  for (int i = 0; i < 3 * TICK_RATE; ++i) advance(i == 0);
  ASSERT_NE(modal_state(), nullptr);
  const double before = modal_state()->modes().modes().frequency[0];
  const int limb = scene.tree(0).skeleton.depth_end[0];
  scene.forest.cut({0, limb});
  for (int i = 0; i < 3 * TICK_RATE; ++i) {
    advance(false);
    const Tree tree = replica.grow(0);
    ASSERT_TRUE(tree.skeleton.branches[static_cast<std::size_t>(limb)].broken);
    const auto there = replica.pose(tree, 0, scene.now());
    const auto here = scene.forest.poseForSensors(tree, 0, scene.now());
    for (std::size_t k = 0; k < here.size(); ++k)
      ASSERT_TRUE(there[k].position == here[k].position) << "tick " << i << ", branch " << k;
  }
  ASSERT_NE(modal_state(), nullptr);
  EXPECT_NE(modal_state()->modes().modes().frequency[0], before);
  Forest other(scene.forest.layout(), flatTerrain(), scene.settings);
  other.restore(other.readArchived(scene.forest.archived()));
  EXPECT_EQ(other.hash(), scene.forest.hash());
  scene.advance();
  other.setSensor(scene.sensor);
  other.advance(scene.now());
  EXPECT_EQ(other.hash(), scene.forest.hash());
}

// A tree in modes that loses a limb swings on: its joints bend as those of the whole tree, and what
// the limb did to them changes in time. Without its state it would begin at the balance of the
// wind.
TEST(Cutting, ATreeInModesDoesNotJump) {
  const wind::Field storm({makeBreeze(1, Vec3(12.0, 3.0, 0.0))}, 3);
  Clearing with(storm), without(storm);
  for (Clearing* scene : {&with, &without}) {
    scene->run(3.0);
    scene->forest.setWind(wind::Field());  // the tree swings back
    scene->run(0.1);
  }
  ASSERT_NE(with.forest.sensed().modes.find(0), nullptr);
  const Tree whole = with.tree(0);
  const int limb = whole.skeleton.depth_end[0];
  with.forest.cut({0, limb});
  with.advance();
  without.advance();
  const ModalTreeState* state = with.forest.sensed().modes.find(0);
  ASSERT_NE(state, nullptr);
  const Tree left =
      growTree(with.forest.layout(), 0, with.forest.terrain(), brokenOf(with.forest.broken(), 0));
  ModalForest anew;
  const wind::Field& wind = with.forest.snapshot().wind;
  anew.addTree({with.forest.layout(), with.forest.terrain(), wind, &with.forest.broken()}, 0, false,
               with.now());
  const auto before = without.angles(whole, 0, without.now());
  const auto largest = [&](const ModalTreeState& modes) {
    const auto after = modalAngles(
        left, wind.at(with.now()).relativeTo(left.foot),
        weightsAt(with.forest.sensed().levels.of(0), with.now(), with.forest.layout().motion),
        &modes, with.now());
    double out = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i)
      if (!left.skeleton.branches[i].broken) out = std::max(out, difference(before[i], after[i]));
    return out;
  };
  const double jump = largest(*state), restart = largest(*anew.find(0));
  std::printf("largest jump of a joint: %.4f rad, from a new start %.4f rad\n", jump, restart);
  EXPECT_LT(jump, 0.3 * restart);
  EXPECT_LT(jump, 0.01);
}

TEST(Cutting, ReplicasRejectBranchesThatATreeCannotLose) {
  Listeners all;
  StateUpdate update = all.rig.forest.update(true);
  BrokenBranch foot;
  foot.branch = 0;
  update.trees = {{0, LevelState(), {}, {}, {foot}}};
  EXPECT_EQ(errorOf([&] { all.steady.apply(update); }), "state: tree 0: its foot cannot come off");
  update.trees[0].broken[0].branch = 16000;
  const std::string count = std::to_string(all.rig.branches().size());
  EXPECT_EQ(errorOf([&] { all.steady.apply(update); }),
            "state: tree 0: branch 16000 is not below its " + count + " branches");
}

}  // namespace
}  // namespace vegetation_sim::forest

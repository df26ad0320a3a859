// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Trees that step one after the other, or on several threads.
#include "forest/physics/tree_steps.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "scenes/forest/physics_scene.h"
#include "scenes/forest/step_surroundings.h"

namespace vegetation_sim::forest {
namespace {

constexpr int SIDE = 4;  // trees

Body bodyAt(std::uint32_t i, const Vec3& position, Nanoseconds stamp) {
  Body out;
  out.id = "arm_" + std::to_string(i);
  out.shape = Shape::SPHERE;
  out.size = Vec3(0.4, 0.0, 0.0);
  out.pose.position = position;
  out.velocity = Vec3(1.5, 0.0, 0.0);
  out.stamp = stamp;
  return out;
}

/// A square of trees in a breeze. Grabs pull at some, pushes act on others, and bodies are driven
/// through a few.
class BusyForest {
 public:
  explicit BusyForest(int threads) : rig_(settings(), SIDE) {
    rig_.forest.setThreads(threads);
    rig_.forest.setWind(wind::Field({makeBreeze(1, Vec3(5.0, 2.0, 0.0))}));
    for (std::uint32_t tree = 0; tree < SIDE * SIDE; ++tree) {
      if (tree % 3 == 0) grab(tree);
      if (tree % 3 == 1) push(tree);
    }
  }
  /// Advances one tick and returns the hashes of the state and of the reactions.
  std::pair<std::uint64_t, std::uint64_t> advance() {
    for (const std::uint32_t tree : {2u, 5u, 6u})
      rig_.forest.setBody(
          bodyAt(tree, footOf(tree) + Vec3(0.025 * step_ - 1.0, 0.1, 4.0), rig_.now()));
    ++step_;
    rig_.advance();
    Hash reactions;
    for (const Reaction& r : rig_.forest.reactions()) {
      reactions.add(static_cast<std::uint64_t>(r.at.tree));
      reactions.add(static_cast<std::uint64_t>(r.at.branch));
      reactions.add(r.force);
      contacts_ += r.kind == Reaction::CONTACT;
    }
    return {rig_.forest.hash(), reactions.value()};
  }
  std::size_t physicalTrees() const { return rig_.forest.physicalTrees().size(); }
  int contacts() const { return contacts_; }

 private:
  static PhysicsSettings settings() {
    PhysicsSettings out;
    out.influence_tolerance = 1e-3;
    return out;
  }
  Vec3 footOf(std::uint32_t tree) const {
    return forest::footOf(rig_.forest.layout().trees[tree], rig_.forest.terrain());
  }
  // Returns a branch in the middle of a tree.
  static int middleOf(const Tree& tree) { return tree.skeleton.depth_end[1] - 1; }
  void grab(std::uint32_t tree) {
    const Tree grown = growTree(rig_.forest.layout(), tree, rig_.forest.terrain());
    const int branch = middleOf(grown);
    Grab out;
    out.point = {tree, branch, 0.0};
    out.target = grown.foot +
                 grown.skeleton.branches[static_cast<std::size_t>(branch)].rest.position +
                 Vec3(0.3, 0.2, 0.0);
    out.jaw_length = tree % 2 == 0 ? 0.1 : 0.0;
    rig_.forest.addGrab(out);
  }
  void push(std::uint32_t tree) {
    Push out;
    out.point = {tree, middleOf(growTree(rig_.forest.layout(), tree, rig_.forest.terrain())), 0.0};
    out.force = Vec3(20.0, 10.0, 0.0);
    out.until = rig_.now() + seconds(0.4);
    rig_.forest.push(out);
  }

  PhysicsRig rig_;
  int step_{0}, contacts_{0};
};

TEST(TreeSteps, AnyNumberOfThreadsGivesTheSameStateAndReactions) {
  BusyForest one(1);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> expected;
  for (int tick = 0; tick < 40; ++tick) expected.push_back(one.advance());
  EXPECT_GT(one.physicalTrees(), 10u);
  EXPECT_GT(one.contacts(), 10);
  for (const int threads : {2, 4, 8, 16}) {
    BusyForest several(threads);
    for (std::size_t tick = 0; tick < expected.size(); ++tick)
      ASSERT_EQ(several.advance(), expected[tick]) << threads << " threads, tick " << tick;
  }
}

// A snapshot does not hold the chains, in which the state of the joints is between the steps.
TEST(TreeSteps, ARestoredForestContinuesWithTheSameBits) {
  PhysicsRig rig({}, 2);
  rig.forest.setWind(wind::Field({makeBreeze(1, Vec3(5.0, 2.0, 0.0))}));
  Grab grab = rig.grabOf(rig.branchOfDepth(1));
  grab.target += Vec3(0.3, 0.0, 0.1);
  grab.jaw_length = 0.2;
  rig.forest.addGrab(grab);
  rig.run(0.5);
  const ForestSnapshot saved = rig.forest.snapshot();
  const std::string bytes = rig.forest.archived();
  const std::int64_t tick = rig.tick;
  std::vector<std::uint64_t> hashes;
  rig.run(0.5, [&] { hashes.push_back(rig.forest.hash()); });
  for (const ForestSnapshot& start : {saved, rig.forest.readArchived(bytes)}) {
    rig.forest.restore(start);
    rig.tick = tick;
    std::size_t i = 0;
    rig.run(0.5, [&] { EXPECT_EQ(rig.forest.hash(), hashes[i++]); });
  }
}

/// A tree whose joints are all physical in a breeze.
class WholeTree {
 public:
  WholeTree() : rig_(settings()) {
    wind::Primitive breeze = makeBreeze(1, Vec3(4.0, 2.0, 0.0));
    breeze.turbulence = 0.2;
    rig_.forest.setWind(wind::Field({breeze}));
    touch_.point = {0, rig_.twig(), 0.0};
    touch_.until = rig_.now() + fromSeconds(0.5);
    touch_.whole_tree = true;
    rig_.forest.push(touch_);
    rig_.run(0.5);
  }
  static PhysicsSettings settings() {
    PhysicsSettings out;
    out.promotion = Promotion::DEPTH;
    out.influence_tolerance = 1e-6;  // so that no branch is calm enough to blend back
    out.linger = 3600.0;
    return out;
  }
  void run(double duration) { rig_.run(duration); }
  /// Returns the number of steps of the next 1/30 s.
  std::size_t stepsWith(const PhysicsSettings& settings, bool pushed) {
    const Forest& forest = rig_.forest;
    const Nanoseconds now = rig_.now();
    const StepContext context = surroundings_.at(forest, now);
    PhysicalSubtree subtree = forest.snapshot().physics.subtrees().at(0);
    TreeSteps steps(0, subtree);
    if (pushed) steps.add(touch_);
    return steps.timesIn({context, settings, bodies_, {now, now + fromSeconds(1.0 / 30.0), 8}})
        .count;
  }

 private:
  PhysicsRig rig_;
  Push touch_;
  Bodies bodies_;
  StepSurroundings surroundings_;
};

// Two seconds after the last load a tree takes a quarter of the steps, with the implicit method
// only; a load brings them back at once.
TEST(TreeSteps, AreFewerForCalmTrees) {
  WholeTree tree;
  const PhysicsSettings usual = WholeTree::settings();
  EXPECT_EQ(tree.stepsWith(usual, false), 8U);
  tree.run(CALM_AFTER - 0.3);
  EXPECT_EQ(tree.stepsWith(usual, false), 8U);
  tree.run(0.6);
  EXPECT_EQ(tree.stepsWith(usual, false), 2U);
  EXPECT_EQ(tree.stepsWith(usual, true), 8U);
  PhysicsSettings explicit_steps = usual;
  explicit_steps.integrator = physics::Integrator::SEMI_IMPLICIT_EULER;
  EXPECT_EQ(tree.stepsWith(explicit_steps, false), 8U);
}

}  // namespace
}  // namespace vegetation_sim::forest

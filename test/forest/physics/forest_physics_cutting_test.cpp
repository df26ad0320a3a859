// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Branches that are cut.
#include <gtest/gtest.h>

#include <cstring>

#include "core/error_text.h"
#include "forest/nearest.h"
#include "forest/pick.h"
#include "scenes/forest/physics_scene.h"
#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::forest {
namespace {

// Returns a copy of the tree as it stands in the forest now.
Tree standing(const Forest& forest) {
  return growTree(forest.layout(), 0, forest.terrain(), brokenOf(forest.broken(), 0));
}

std::vector<int> carriedBy(const Skeleton& skeleton, int branch) {
  std::vector<int> out;
  std::vector<char> in(skeleton.branches.size(), 0);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const int parent = skeleton.branches[i].parent;
    in[i] = static_cast<int>(i) == branch || (parent >= 0 && in[static_cast<std::size_t>(parent)]);
    if (in[i]) out.push_back(static_cast<int>(i));
  }
  return out;
}

// The mass that is told of a piece is its own, without the fluid that moves with it.
TEST(Cutting, PiecesWeighTheSameInWater) {
  double mass[2];
  for (const bool wet : {false, true}) {
    Layout layout = PhysicsRig::makeLayout(1, "oak");
    if (wet) layout.species[0].fluid_density = 1025.0;
    PhysicsRig rig(layout);
    rig.forest.cut({0, rig.tree.skeleton.depth_end[0]});
    rig.advance();
    ASSERT_EQ(rig.forest.breaks().size(), 1u);
    mass[wet] = rig.forest.breaks().front().mass;
  }
  EXPECT_NEAR(mass[1], mass[0], 1e-12 * mass[0]);
}

// Cut a limb of an oak: with it goes what it carries, for whatever looks at the tree.
TEST(Cutting, TakesOffTheBranchWithAllThatItCarries) {
  PhysicsRig rig;
  const int limb = rig.tree.skeleton.depth_end[0];
  const std::vector<int> gone = carriedBy(rig.tree.skeleton, limb);
  ASSERT_GT(gone.size(), 3u);
  const std::uint64_t before = rig.forest.hash();
  rig.forest.cut({0, limb});
  EXPECT_TRUE(rig.forest.broken().empty()) << "before the tick";
  EXPECT_NE(rig.forest.hash(), before);
  rig.advance();
  ASSERT_EQ(rig.forest.breaks().size(), 1u);
  const Break& cut = rig.forest.breaks().front();
  EXPECT_TRUE(cut.piece.cut);
  EXPECT_EQ(cut.piece.branch, limb);
  EXPECT_EQ(cut.piece.stamp, rig.now());
  const Species& oak = rig.forest.layout().species[0];
  EXPECT_NEAR(cut.mass, woodOf(rig.tree.skeleton, oak, Material::BEAM).subtree[limb].mass, 1e-9);
  EXPECT_NEAR(length(cut.piece.pose.position - rig.tree.foot - rig.branches()[limb].rest.position),
              0.0, 1e-6);

  const Tree left = standing(rig.forest);
  std::vector<int> broken;
  for (std::size_t i = 0; i < left.skeleton.branches.size(); ++i)
    if (left.skeleton.branches[i].broken) broken.push_back(static_cast<int>(i));
  EXPECT_EQ(broken, gone);
  const TreeMesh mesh = buildMesh(left.skeleton, oak, meshDetail(GEOMETRY_LEVELS - 1));
  const TreeMesh whole = buildMesh(rig.tree.skeleton, oak, meshDetail(GEOMETRY_LEVELS - 1));
  EXPECT_LT(mesh.bark.size(), whole.bark.size());
  EXPECT_LT(mesh.leaves.size(), whole.leaves.size());
  for (const BarkVertex& vertex : mesh.bark)
    EXPECT_FALSE(left.skeleton.branches[vertex.branch].broken);
  for (const LeafCard& leaf : mesh.leaves) EXPECT_FALSE(left.skeleton.branches[leaf.branch].broken);

  // Neither a ray nor a search near its middle finds it.
  const Branch& b = rig.branches()[limb];
  const Vec3 middle = rig.tree.foot + b.rest.position + 0.5 * b.length * axisZ(b.rest.orientation);
  const auto posed = [&](const Tree& tree) {
    return PosedTree{std::make_shared<const Tree>(tree), rig.forest.pose(tree, 0, rig.now())};
  };
  const auto nearest = [&](const Tree& tree) {
    return nearestBranch(rig.forest.layout(), rig.forest.terrain(), middle, 0.01,
                         [&](std::uint32_t) { return posed(tree); });
  };
  ASSERT_TRUE(nearest(rig.tree));
  EXPECT_EQ(nearest(rig.tree)->at.branch, limb);
  EXPECT_FALSE(nearest(left));
  const Ray ray{middle + Vec3(0.0, 0.0, 0.3), Vec3(0.0, 0.0, -1.0), 0.0};
  const auto hit = pickBranch(rig.tree, rig.forest.pose(rig.tree, 0, rig.now()), ray);
  ASSERT_TRUE(hit);
  const auto other = pickBranch(left, rig.forest.pose(left, 0, rig.now()), ray);
  EXPECT_TRUE(!other || !left.skeleton.branches[other->branch].broken);
}

// A body where the limb was touches nothing, and what is left bends less in the wind.
TEST(Cutting, WhatIsGoneBearsNoWindAndTouchesNothing) {
  PhysicsRig rig;
  const int limb = rig.tree.skeleton.depth_end[0];
  const Branch& b = rig.branches()[limb];
  const int top = rig.tree.skeleton.depth_end[0] - 1;
  rig.forest.setWind(wind::Field({makeBreeze(1, Vec3(6.0, 0.0, 0.0))}));
  rig.advance();
  const auto bend = [&] {
    return length(rig.tip(top) - rig.tree.foot -
                  tipOf(rig.branches()[top], rig.branches()[top].rest));
  };
  const double with = bend();
  rig.forest.cut({0, limb});
  rig.advance();
  rig.tree = standing(rig.forest);
  EXPECT_GT(bend(), 0.0);
  EXPECT_LT(bend(), 0.999 * with);
  Body ball;
  ball.id = "ball";
  ball.shape = Shape::SPHERE;
  ball.size = Vec3(0.05, 0.0, 0.0);
  ball.pose.position = rig.tree.foot + tipOf(b, b.rest);
  ball.stamp = rig.now();
  rig.forest.setBody(ball);
  rig.run(0.5);
  for (const Reaction& reaction : rig.forest.reactions())
    EXPECT_FALSE(rig.tree.skeleton.branches[reaction.at.branch].broken);
}

TEST(Cutting, GrabsAndPushesOfThePieceEnd) {
  PhysicsRig rig;
  const int limb = rig.tree.skeleton.depth_end[0];
  const int carried = carriedBy(rig.tree.skeleton, limb).back();
  const std::uint32_t there = rig.forest.addGrab(rig.grabOf(carried));
  const std::uint32_t elsewhere = rig.forest.addGrab(rig.grabOf(limb + 1));
  rig.touch(carried, 5.0);
  rig.run(0.2);
  rig.forest.cut({0, limb});
  rig.advance();
  ASSERT_EQ(rig.forest.ended().size(), 1u);
  EXPECT_EQ(rig.forest.ended().front().id, there);
  EXPECT_EQ(rig.forest.breaks().front().grabs, std::vector<std::uint32_t>{there});
  EXPECT_EQ(rig.forest.grabs().count(elsewhere), 1u);
  for (const PromotedBranch& branch : rig.forest.promoted(0).branches)
    EXPECT_FALSE(standing(rig.forest).skeleton.branches[branch.branch].broken);
  rig.run(0.5);
  const std::string held = errorOf([&] { rig.forest.addGrab(rig.grabOf(carried)); });
  EXPECT_EQ(held, "grab: branch = " + std::to_string(carried) + " has come off");
}

TEST(Cutting, RejectsWhatCannotBeCut) {
  PhysicsRig rig;
  const std::string last = std::to_string(rig.branches().size() - 1);
  EXPECT_EQ(errorOf([&] {
              rig.forest.cut({1, 1});
            }),
            "cut: tree = 1 is unknown, allowed are 0 to 0");
  EXPECT_EQ(errorOf([&] {
              rig.forest.cut({0, 0});
            }),
            "cut: branch = 0 of tree 0 is outside 1 to " + last + "; 0 is the foot of the trunk");
  EXPECT_EQ(errorOf([&] {
              rig.forest.cut({0, -1});  // 4294967295 in a message
            }),
            "cut: branch = 4294967295 of tree 0 is outside 1 to " + last +
                "; 0 is the foot of the trunk");
  EXPECT_NE(errorOf([&] { rig.forest.cut({0, static_cast<int>(rig.branches().size())}); }), "");
  const int limb = rig.tree.skeleton.depth_end[0];
  rig.forest.cut({0, limb});
  rig.forest.cut({0, carriedBy(rig.tree.skeleton, limb).back()});  // goes with the limb
  rig.advance();
  EXPECT_EQ(rig.forest.breaks().size(), 1u);
  EXPECT_EQ(errorOf([&] {
              rig.forest.cut({0, limb});
            }),
            "cut: branch = " + std::to_string(limb) + " of tree 0 has come off");
  rig.forest.reset();
  rig.forest.cut({0, limb});  // whole again
}

// A branch comes off where it is at the tick that its record names, in the forest as in wind.
TEST(Cutting, APieceBeginsWhereItsBranchIsAtTheTick) {
  PhysicsRig with, without;
  for (PhysicsRig* rig : {&with, &without}) {
    rig->forest.setWind(steadyWind(Vec3(9.0, 2.0, 0.0), 6.0));
    rig->run(0.4);
  }
  const int twig = with.twig(), held = with.branchOfDepth(1);
  for (PhysicsRig* rig : {&with, &without}) {
    Grab grab = rig->grabOf(held);
    grab.target += Vec3(0.0, 0.4, 0.1);
    rig->forest.addGrab(grab);
    rig->run(0.1);
  }
  const std::vector<Pose> last = without.forest.pose(without.tree, 0, without.now());
  with.forest.cut({0, twig});
  with.forest.cut({0, held});
  with.advance();
  without.advance();
  const std::vector<Pose> now = without.forest.pose(without.tree, 0, without.now());
  ASSERT_EQ(with.forest.breaks().size(), 2u);
  for (const Break& cut : with.forest.breaks()) {
    const Vec3 place = cut.piece.pose.position - with.tree.foot;
    const auto branch = static_cast<std::size_t>(cut.piece.branch);
    EXPECT_GT(length(now[branch].position - last[branch].position), 1e-4);
    EXPECT_NEAR(length(place - now[branch].position), 0.0, 1e-6) << branch;
  }
}

// Of what is cut at once, each piece has the mass of what goes with it.
TEST(Cutting, PiecesOfOneTickShareTheMassOfWhatCarriedThem) {
  PhysicsRig one, both;
  const int limb = one.tree.skeleton.depth_end[0];
  const int carried = carriedBy(one.tree.skeleton, limb).back();
  one.forest.cut({0, limb});
  both.forest.cut({0, carried});
  both.forest.cut({0, limb});
  one.advance();
  both.advance();
  ASSERT_EQ(one.forest.breaks().size(), 1u);
  ASSERT_EQ(both.forest.breaks().size(), 2u);
  EXPECT_EQ(both.forest.breaks()[0].piece.branch, carried);
  EXPECT_GT(both.forest.breaks()[0].mass, 0.0);
  EXPECT_NEAR(both.forest.breaks()[0].mass + both.forest.breaks()[1].mass,
              one.forest.breaks()[0].mass, 1e-9);
}

// However many branches of a tree are cut in a tick, the tree is grown once.
TEST(Cutting, ABurstOfCutsGrowsATreeOnce) {
  PhysicsRig rig;
  const int first = rig.tree.skeleton.depth_end[1];  // none carries another in its limb's place
  const int count = 60;
  for (int i = 0; i < count; ++i) rig.forest.cut({0, first + i});
  EXPECT_EQ(rig.forest.snapshot().physics.grownToCut(), 1u);
  rig.advance();
  EXPECT_EQ(rig.forest.snapshot().physics.grownToCut(), 1u);
  EXPECT_GT(rig.forest.breaks().size(), 30u);
  const Tree left = standing(rig.forest);
  for (int i = 0; i < count; ++i)
    EXPECT_TRUE(left.skeleton.branches[static_cast<std::size_t>(first + i)].broken) << i;
}

// Cuts of more trees than a tick can grow are made in the next ticks, with equal bits for any
// number of threads and from a snapshot that has some left.
TEST(Cutting, CutsBeyondTheWorkOfATickFollow) {
  PhysicsRig rig({}, 16), other({}, 16);
  other.forest.setThreads(3);
  std::size_t branches = 0;
  for (std::uint32_t id = 0; id < 256; ++id)
    branches += growTree(rig.forest.layout(), id, rig.forest.terrain()).skeleton.branches.size();
  ASSERT_GT(branches, MOST_CUT_BRANCHES);
  for (PhysicsRig* each : {&rig, &other})
    for (std::uint32_t id = 0; id < 256; ++id) each->forest.cut({id, 2});
  rig.advance();
  const std::size_t at_once = rig.forest.broken().size();
  EXPECT_GT(at_once, 20u);
  EXPECT_LT(at_once, 256u);
  EXPECT_LT(at_once * branches / 256, 1.2 * MOST_CUT_BRANCHES);
  other.forest.restore(other.forest.readArchived(rig.forest.archived()));
  other.tick = rig.tick;
  EXPECT_EQ(other.forest.hash(), rig.forest.hash());
  const std::size_t ticks = branches / MOST_CUT_BRANCHES + 1;
  for (std::size_t i = 0; i < ticks; ++i)
    for (PhysicsRig* each : {&rig, &other}) each->advance();
  EXPECT_EQ(rig.forest.broken().size(), 256u);
  EXPECT_EQ(other.forest.hash(), rig.forest.hash());
}

// A cut that waits ends if its branch breaks off before, with the limb that carried it.
TEST(Cutting, ACutThatWaitsEndsWithItsBranch) {
  Layout layout = PhysicsRig::makeLayout(16, "oak");
  layout.species[0].strength = 10.0;  // [Pa]
  PhysicsRig rig(layout);
  const Tree last = growTree(rig.forest.layout(), 255, rig.forest.terrain());
  const int limb = last.skeleton.depth_end[0];
  Push push;
  push.point = {255, limb, 0.0};
  push.point.along = last.skeleton.branches[static_cast<std::size_t>(limb)].length;
  push.force = Vec3(0.0, 0.0, -500.0);
  push.until = rig.now() + seconds(1.0);
  rig.forest.push(push);
  for (std::uint32_t id = 0; id < 255; ++id) rig.forest.cut({id, 2});
  rig.forest.cut({255, carriedBy(last.skeleton, limb).back()});
  rig.advance();
  ASSERT_LT(rig.forest.broken().size(), 250u);
  ASSERT_EQ(rig.forest.broken().count(255), 1u);
  ASSERT_EQ(rig.forest.broken().at(255).front().branch, limb);
  EXPECT_NO_THROW(rig.forest.readArchived(rig.forest.archived()));
  for (int i = 0; i < 10; ++i) rig.advance();
  for (const BrokenBranch& piece : rig.forest.broken().at(255)) EXPECT_FALSE(piece.cut);
  EXPECT_EQ(rig.forest.broken().size(), 256u);
}

// A snapshot of a forest whose trees have more branches is rejected.
TEST(Cutting, ASnapshotWithABranchThatATreeLacksIsRejected) {
  PhysicsRig rig;
  const int last = static_cast<int>(rig.branches().size()) - 1;
  rig.forest.cut({0, last});
  rig.advance();
  const std::string bytes = rig.forest.archived();
  const auto record = [&](int branch) {
    std::string out(12, '\0');
    const std::int32_t index = branch;
    const std::int64_t stamp = rig.now();
    std::memcpy(&out[0], &index, sizeof index);
    std::memcpy(&out[4], &stamp, sizeof stamp);
    return out;
  };
  const std::size_t at = bytes.find(record(last));
  ASSERT_NE(at, std::string::npos);
  std::string other = bytes;
  other.replace(at, 12, record(last + 1));
  EXPECT_NO_THROW(rig.forest.readArchived(bytes));
  EXPECT_EQ(
      errorOf([&] { rig.forest.readArchived(other); }),
      "broken branch = " + std::to_string(last + 1) + " is outside 1 to " + std::to_string(last));
}

}  // namespace
}  // namespace vegetation_sim::forest

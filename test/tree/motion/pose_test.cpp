// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

Tree growOne(int species, JointModel model = JointModel::SWING) {
  Layout layout = gridLayout(2, 10.0);
  layout.motion.joint_model = model;
  return growTree(layout, static_cast<std::uint32_t>(species), terrain::HeightMap());
}

wind::Instant blow(const std::vector<wind::Primitive>& primitives, const Tree& tree, double t) {
  return wind::Field(primitives).at(seconds(t)).relativeTo(tree.foot);
}

// S1-19: superposition of two primitives is exact while no joint is near its limit.
TEST(Pose, PrimitivesAddUp) {
  const Tree tree = growOne(0);
  const auto a = makeDisk(1, Vec3(3, 0, 0), 30.0, Vec3(2, 0.5, 0));
  const auto b = makeDisk(2, Vec3(-5, 2, 0), 25.0, Vec3(-0.4, 1, 0));
  const auto both = proceduralAngles(tree, blow({a, b}, tree, 0.7), fullWeights());
  const auto first = proceduralAngles(tree, blow({a}, tree, 0.7), fullWeights());
  const auto second = proceduralAngles(tree, blow({b}, tree, 0.7), fullWeights());
  double largest = 0.0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (std::hypot(both[i].first, both[i].second) > BEND_KNEE) continue;
    EXPECT_NEAR(both[i].first, first[i].first + second[i].first, 1e-14);
    EXPECT_NEAR(both[i].second, first[i].second + second[i].second, 1e-14);
    largest = std::max(largest, std::fabs(both[i].first));
  }
  EXPECT_GT(largest, 1e-3);
}

// S1-19: poses are a function of time alone, in any order of calls.
TEST(Pose, AnglesDoNotDependOnHistory) {
  const Tree tree = growOne(2);
  const std::vector<wind::Primitive> wind{makeBreeze(1, Vec3(5, 2, 0))};
  const auto early = proceduralAngles(tree, blow(wind, tree, 1.0), fullWeights());
  proceduralAngles(tree, blow(wind, tree, 77.7), fullWeights());
  const auto again = proceduralAngles(tree, blow(wind, tree, 1.0), fullWeights());
  for (std::size_t i = 0; i < early.size(); ++i) {
    EXPECT_EQ(early[i].first, again[i].first);
    EXPECT_EQ(early[i].second, again[i].second);
  }
}

// S1-20: the motion of the tip has the frequency, magnitude and direction of the wind.
TEST(Pose, TipFollowsPulsationMagnitudeAndDirection) {
  const Tree tree = growOne(1);
  const auto tipAt = [&](double t, const Vec3& v) {
    const auto disk = makeDisk(1, Vec3(0, 0, 0), 200.0, v);
    const auto poses = poseBranches(tree, blow({disk}, tree, t), fullWeights());
    return Vec3(tipOf(tree.skeleton.branches[7], poses[7]));
  };
  const Vec3 rest = tipAt(0.0, Vec3(1, 0, 0));
  const double quarter = PI / 2.0 / 2.0;  // omega = 2 rad/s
  const Vec3 push = tipAt(quarter, Vec3(1, 0, 0)) - rest;
  EXPECT_GT(push.x(), 1e-4);
  EXPECT_GT(push.x(), 5.0 * std::fabs(push.y()));
  EXPECT_NEAR(length(tipAt(quarter, Vec3(2, 0, 0)) - rest), 2.0 * length(push),
              0.02 * length(push));
  EXPECT_NEAR(length(tipAt(3.0 * quarter, Vec3(1, 0, 0)) - rest + push), 0.0, 0.02 * length(push));
  const Vec3 side = tipAt(quarter, Vec3(0, 1, 0)) - rest;
  EXPECT_GT(side.y(), 5.0 * std::fabs(side.x()));
}

// E3: the angles of a branch are the same whether or not its parents move.
TEST(Pose, AnglesAreIndependentOfTheParents) {
  const Tree tree = growOne(0);
  const auto wind = blow({makeBreeze(1, Vec3(6, 0, 0))}, tree, 3.0);
  Weights only_twigs{};
  only_twigs[3] = 1.0;
  const auto all = proceduralAngles(tree, wind, fullWeights());
  const auto some = proceduralAngles(tree, wind, only_twigs);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (tree.skeleton.branches[i].depth != 3) continue;
    EXPECT_EQ(all[i].first, some[i].first);
    EXPECT_EQ(all[i].second, some[i].second);
  }
}

// S1-21: joints deeper than the level stay at rest.
TEST(Pose, DeeperJointsAreFixed) {
  const Tree tree = growOne(3);
  const auto wind = blow({makeBreeze(1, Vec3(6, 0, 0))}, tree, 3.0);
  Weights trunk_only{};
  trunk_only[0] = 1.0;
  const auto angles = proceduralAngles(tree, wind, trunk_only);
  bool moved = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (tree.skeleton.branches[i].depth == 0) moved |= angles[i].first != 0.0;
    if (tree.skeleton.branches[i].depth > 0) {
      EXPECT_EQ(angles[i].first, 0.0);
      EXPECT_EQ(angles[i].second, 0.0);
    }
  }
  EXPECT_TRUE(moved);
}

// E6: without wind a tree keeps its rest shape through every weight; with angles for deviations
// (the printed form) it would fold.
TEST(Pose, NoWindLeavesTheRestShape) {
  for (const JointModel model : {JointModel::SWING, JointModel::PAPER}) {
    const Tree tree = growOne(0, model);
    for (const double weight : {0.0, 0.3, 1.0}) {
      Weights weights;
      weights.fill(weight);
      const auto poses = poseBranches(tree, wind::Instant(), weights);
      for (std::size_t i = 0; i < poses.size(); ++i)
        EXPECT_NEAR(length(poses[i].position - tree.skeleton.branches[i].rest.position), 0.0,
                    1e-12);
    }
  }
}

TEST(Pose, BranchesKeepTheirLengthAndHoldTogether) {
  const Tree tree = growOne(2);
  const auto poses =
      poseBranches(tree, blow({makeBreeze(1, Vec3(20, 5, 0))}, tree, 9.0), fullWeights());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& b = tree.skeleton.branches[i];
    const Quat& q = poses[i].orientation;
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-12);
    if (b.parent < 0) continue;
    const Pose& parent = poses[static_cast<std::size_t>(b.parent)];
    EXPECT_NEAR(length(poses[i].position - parent.position), b.h, 1e-12);
  }
}

// S2-16, S2-19: every tree of a forest responds to the same gust, later where it arrives later.
TEST(Pose, GustReachesTreesInTurn) {
  const Layout layout = gridLayout(6, 10.0);
  wind::Primitive gust;
  gust.id = 1;
  gust.name = "gust";
  gust.kind = wind::Kind::GUST;
  gust.trajectory = {{0, Vec3(-5, 25, 0)}};
  gust.velocity = Vec3(10, 0, 0);
  gust.front_speed = 5.0;
  gust.radius = 200.0;
  gust.fade_in = gust.fade_out = 0.0;
  const wind::Field field({gust});
  const auto sway = [&](std::uint32_t id, double t) {
    const Tree tree = growTree(layout, id, terrain::HeightMap());
    const auto poses =
        poseBranches(tree, field.at(seconds(t)).relativeTo(tree.foot), fullWeights());
    const std::size_t last = poses.size() - 1;
    return length(tipOf(tree.skeleton.branches[last], poses[last]) -
                  tipOf(tree.skeleton.branches[last], tree.skeleton.branches[last].rest));
  };
  for (std::uint32_t column = 0; column < 6; ++column) {
    const double arrival = (10.0 * column + 5.0) / 5.0;
    EXPECT_NEAR(sway(column, arrival - 1.5), 0.0, 1e-9) << column;  // crowns reach 6 m ahead
    EXPECT_GT(sway(column, arrival + 2.5), 1e-3) << column;
  }
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/falling_piece.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/forest/physics_scene.h"
#include "tree/growth/wood.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

/// A limb of an oak that comes off with a given motion.
struct Falling {
  Layout layout{PhysicsRig::makeLayout(1, "oak")};
  terrain::HeightMap flat;
  Tree whole{growTree(layout, 0, flat)};
  BrokenBranches broken{BrokenBranch()};
  Composite body;

  explicit Falling(const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
    BrokenBranch& record = broken.front();
    record.branch = whole.skeleton.depth_end[0];
    record.stamp = PHYSICS_START;
    record.pose = rest().rest;
    record.pose.position = Vec3(whole.foot + record.pose.position);
    record.velocity = velocity;
    record.spin = spin;
    body = woodOf(whole.skeleton, layout.species[0], Material::BEAM).subtree[root()];
  }
  std::size_t root() const { return static_cast<std::size_t>(broken.front().branch); }
  const Branch& rest() const { return whole.skeleton.branches[root()]; }
  FallingPiece piece() const { return FallingPiece(layout, flat, 0, broken, 0); }
  Vec3 centreOf(const FallingPiece& piece, Nanoseconds stamp) const {
    const Pose joint = piece.poseAt(stamp)[root()];
    return whole.foot + joint.position + rotate(joint.orientation, Vec3(body.moment / body.mass));
  }
};

double lowest(const FallingPiece& piece, Nanoseconds stamp) {
  const auto poses = piece.poseAt(stamp);
  double out = 1e9;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& branch = piece.tree().skeleton.branches[i];
    if (branch.broken) continue;
    out = std::min({out, poses[i].position.z(), tipOf(branch, poses[i]).z()});
  }
  return out + piece.tree().foot.z();
}

// Its centre of mass falls by g t^2 / 2 and drifts by the velocity that it had; tolerance:
// rounding.
TEST(FallingPiece, CentreOfMassFallsFreely) {
  const Vec3 velocity(0.5, -0.2, 0.1), spin(0.3, 0.8, -0.4);
  const Falling scene(velocity, spin);
  const FallingPiece piece = scene.piece();
  ASSERT_GT(piece.landsAt(), PHYSICS_START + seconds(0.3));
  const Vec3 start = scene.centreOf(piece, PHYSICS_START);
  const Vec3 arm = start - scene.broken.front().pose.position;
  for (const double t : {0.05, 0.1, 0.2, 0.3}) {
    const Vec3 fallen = start + t * (velocity + cross(spin, arm)) - Vec3(0, 0, 0.5 * 9.81 * t * t);
    EXPECT_NEAR(length(scene.centreOf(piece, PHYSICS_START + seconds(t)) - fallen), 0.0, 1e-9) << t;
  }
  const Pose joint = piece.poseAt(PHYSICS_START)[scene.root()];
  EXPECT_NEAR(length(joint.position - scene.rest().rest.position), 0.0, 1e-12);
  const Pose later = piece.poseAt(PHYSICS_START + seconds(0.3))[scene.root()];
  const Quat turn = later.orientation * conjugate(joint.orientation);
  EXPECT_NEAR(2.0 * std::acos(std::fabs(turn.w)), 0.3 * length(spin), 1e-9);
}

// It meets the ground with its lowest point, without a jump, and lies level on it. Tolerance:
// between the heights that are computed the lowest point is off by what a chord of an arc is.
TEST(FallingPiece, LandsAndLiesOnTheGround) {
  const Falling scene(Vec3(0.4, 0.0, 0.0), Vec3(0.0, 1.0, 0.5));
  const FallingPiece piece = scene.piece();
  EXPECT_GT(lowest(piece, piece.landsAt() - seconds(0.01)), 0.0);
  EXPECT_NEAR(lowest(piece, piece.landsAt()), 0.0, 1e-6);
  EXPECT_NEAR(lowest(piece, piece.restsFrom()), 0.0, 1e-6);
  for (int i = 1; i < 10; ++i)
    EXPECT_NEAR(lowest(piece, piece.landsAt() + seconds(0.05 * i)), 0.0, 0.02) << i;
  const Vec3 before = scene.centreOf(piece, piece.landsAt() - 1000);
  EXPECT_NEAR(length(scene.centreOf(piece, piece.landsAt() + 1000) - before), 0.0, 1e-4);
  const auto rests = piece.poseAt(piece.restsFrom()), later = piece.poseAt(piece.restsFrom() * 2);
  for (std::size_t i = 0; i < rests.size(); ++i)
    EXPECT_TRUE(rests[i].position == later[i].position);
  const double height = scene.centreOf(piece, piece.restsFrom()).z();
  EXPECT_NEAR(height, scene.whole.foot.z() + rests[scene.root()].position.z(), 1e-6);
}

// Tree and piece together are the whole tree: each branch, with its leaves, is in one of them.
TEST(FallingPiece, IsWhatTheTreeHasLost) {
  const Falling scene;
  const Tree left = growTree(scene.layout, 0, scene.flat, scene.broken);
  const FallingPiece piece = scene.piece();
  int leaves = 0;
  for (std::size_t i = 0; i < left.skeleton.branches.size(); ++i) {
    const Branch &there = left.skeleton.branches[i], &here = piece.tree().skeleton.branches[i];
    EXPECT_NE(there.broken, here.broken) << i;
    EXPECT_EQ(there.leaves + here.leaves, scene.whole.skeleton.branches[i].leaves) << i;
    leaves += here.leaves;
  }
  EXPECT_GT(leaves, 0);
}

// A branch that came off before is no part of the limb that carried it.
TEST(FallingPiece, LacksWhatHadComeOffBefore) {
  Falling scene;
  BrokenBranch first = scene.broken.front();
  for (std::size_t i = scene.root() + 1; i < scene.whole.skeleton.branches.size(); ++i)
    if (scene.whole.skeleton.branches[i].parent == scene.broken.front().branch)
      first.branch = static_cast<int>(i);
  ASSERT_NE(first.branch, scene.broken.front().branch);
  scene.broken.insert(scene.broken.begin(), first);
  const FallingPiece limb(scene.layout, scene.flat, 0, scene.broken, 1);
  const auto& branches = limb.tree().skeleton.branches;
  EXPECT_TRUE(branches[static_cast<std::size_t>(first.branch)].broken);
  EXPECT_FALSE(branches[static_cast<std::size_t>(scene.broken[1].branch)].broken);
  const auto order = piecesOf({{3, scene.broken}, {1, {first}}});
  ASSERT_EQ(order.size(), 3u);
  EXPECT_EQ(order[0].tree, 1u);
  EXPECT_EQ(order[2].number, 1u);
}

}  // namespace
}  // namespace vegetation_sim::forest

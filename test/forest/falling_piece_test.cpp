// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/falling_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error_text.h"
#include "scenes/forest/physics_scene.h"
#include "tree/growth/branch_mass.h"
#include "tree/growth/broken_branch.h"
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

  explicit Falling(const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                   double fluid_density = AIR_DENSITY) {
    layout.species[0].fluid_density = fluid_density;
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
    const Pose joint = piece.poseAt(stamp).front();
    return whole.foot + joint.position + rotate(joint.orientation, Vec3(body.moment / body.mass));
  }
};

double lowest(const FallingPiece& piece, Nanoseconds stamp) {
  const auto poses = piece.poseAt(stamp);
  double out = 1e9;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& branch = piece.tree().skeleton.branches[i];
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
  const Pose joint = piece.poseAt(PHYSICS_START).front();
  EXPECT_NEAR(length(joint.position - scene.rest().rest.position), 0.0, 1e-12);
  const Pose later = piece.poseAt(PHYSICS_START + seconds(0.3)).front();
  const Quat turn = later.orientation * conjugate(joint.orientation);
  EXPECT_NEAR(2.0 * std::acos(std::fabs(turn.w)), 0.3 * length(spin), 1e-9);
}

// N11: in water the weight of the displaced water is gone, as much water moves with the piece, and
// linear drag takes its speed. Reference: small explicit steps; tolerance: their error.
TEST(FallingPiece, WaterCarriesAndBrakesIt) {
  const Vec3 velocity(0.5, -0.2, 0.3);
  for (const double water : {500.0, 1025.0}) {
    const Falling scene(velocity, Vec3::Zero(), water);
    const Species& oak = scene.layout.species[0];
    const double excess = water - AIR_DENSITY, drag = scene.body.drag * excess / water;
    const double own = scene.body.mass * oak.density / (oak.density + excess);
    const double weight = 9.81 * own * (1.0 - excess / oak.density);
    const FallingPiece piece = scene.piece();
    Vec3 centre = scene.centreOf(piece, PHYSICS_START), speed = velocity;
    constexpr double STEP = 1e-4;
    for (int i = 1; i <= 5000; ++i) {
      const Vec3 force = Vec3(0, 0, -weight) - drag * speed;
      const Vec3 change = (STEP / scene.body.mass) * force;
      centre += STEP * (speed + 0.5 * change);
      speed += change;
      if (i % 500 != 0 || PHYSICS_START + seconds(STEP * i) > piece.landsAt()) continue;
      EXPECT_NEAR(length(scene.centreOf(piece, PHYSICS_START + seconds(STEP * i)) - centre), 0.0,
                  1e-3)
          << water << " " << STEP * i;
    }
  }
}

TEST(FallingPiece, RisesInAHeavierFluidAndSinksInALighterOne) {
  const auto risen = [](double fluid_density) {
    const Falling scene(Vec3::Zero(), Vec3::Zero(), fluid_density);
    const FallingPiece piece = scene.piece();
    return scene.centreOf(piece, PHYSICS_START + seconds(0.3)).z() -
           scene.centreOf(piece, PHYSICS_START).z();
  };
  const double density = Falling().layout.species[0].density;
  EXPECT_GT(risen(1.1 * density), 1e-4);
  EXPECT_NEAR(risen(density + AIR_DENSITY), 0.0, 1e-9);
  EXPECT_LT(risen(0.9 * density), -1e-4);
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
  EXPECT_NEAR(height, scene.whole.foot.z() + rests.front().position.z(), 1e-6);
}

// Tree and piece together are the whole tree: each branch, with its leaves, is in one of them, at
// the same place of its limb. The piece has no others, so that it costs what its branches cost.
TEST(FallingPiece, IsWhatTheTreeHasLost) {
  const Falling scene;
  const Tree left = growTree(scene.layout, 0, scene.flat, scene.broken);
  const FallingPiece piece = scene.piece();
  const Skeleton& own = piece.tree().skeleton;
  ASSERT_EQ(own.branches.size(), piece.branches().size());
  EXPECT_EQ(piece.branches().front(), scene.broken.front().branch);
  EXPECT_GE(piece.work(), left.skeleton.branches.size());
  int leaves = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < left.skeleton.branches.size(); ++i) {
    const Branch &there = left.skeleton.branches[i], &before = scene.whole.skeleton.branches[i];
    if (!there.broken) {
      EXPECT_EQ(there.leaves, before.leaves) << i;
      continue;
    }
    ASSERT_LT(next, own.branches.size());
    EXPECT_EQ(piece.branches()[next], static_cast<int>(i));
    const Branch& here = own.branches[next++];
    EXPECT_FALSE(here.broken);
    EXPECT_EQ(here.key, before.key);
    EXPECT_EQ(here.leaves, before.leaves) << i;
    EXPECT_EQ(here.rest.position, before.rest.position);
    const auto in_tree = [&](int at) {
      return at < 0 ? -1 : piece.branches()[static_cast<std::size_t>(at)];
    };
    EXPECT_EQ(in_tree(here.next), before.next);
    EXPECT_EQ(in_tree(here.parent), next > 1 ? before.parent : -1);
    leaves += here.leaves;
  }
  EXPECT_EQ(next, own.branches.size());
  EXPECT_GT(leaves, 0);
  int end = 0;
  for (const Group& group : own.groups) {
    EXPECT_EQ(group.begin, end);
    for (int i = group.begin; i < group.end; ++i)
      EXPECT_EQ(own.branches[static_cast<std::size_t>(i)].depth, group.depth);
    end = group.end;
  }
  EXPECT_EQ(end, own.depth_end.back());
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
  EXPECT_EQ(limb.branches().front(), scene.broken[1].branch);
  EXPECT_FALSE(std::binary_search(limb.branches().begin(), limb.branches().end(), first.branch));
  const auto order = piecesOf({{3, scene.broken}, {1, {first}}});
  ASSERT_EQ(order.size(), 3u);
  EXPECT_EQ(order[0].tree, 1u);
  EXPECT_EQ(order[2].number, 1u);
}

// What a state may contain: neither the flight nor the work to find where it ends is long. A piece
// that meets no ground rests in the air.
TEST(FallingPiece, TheFastestFallIsBounded) {
  BrokenBranch fastest;
  fastest.velocity = Vec3(FASTEST_PIECE, 0.0, FASTEST_PIECE);
  fastest.spin = Vec3(0.0, 0.0, FASTEST_PIECE_SPIN);
  Faults faults;
  check(fastest, "piece: ", faults);
  EXPECT_TRUE(faults.empty());
  fastest.velocity.x() = 1e6;
  fastest.spin.y() = -2000.0;
  check(fastest, "piece: ", faults);
  EXPECT_EQ(errorOf([&] { faults.throwIfAny(); }),
            "piece: velocity.x = 1e+06 m/s is outside -200 to 200 m/s\n"
            "piece: spin.y = -2000 rad/s is outside -1000 to 1000 rad/s");
  limitMotion(fastest);
  EXPECT_NEAR(length(fastest.velocity), FASTEST_PIECE, 1e-9);
  EXPECT_NEAR(length(fastest.spin), FASTEST_PIECE_SPIN, 1e-9);

  Falling scene(Vec3(FASTEST_PIECE, 0.0, FASTEST_PIECE), Vec3(0.0, 0.0, FASTEST_PIECE_SPIN));
  const FallingPiece piece = scene.piece();
  EXPECT_LE(piece.restsFrom(), PHYSICS_START + seconds(11.0));
  EXPECT_LE(piece.work(), 2 * scene.whole.skeleton.branches.size());
  const Vec3 way = piece.placeAt(piece.restsFrom()) - piece.placeAt(PHYSICS_START);
  EXPECT_LE(length(way), 2.0 * 10.0 * FASTEST_PIECE);
  const double size = sizeBound(scene.layout.species[0]);
  const Vec3 end = piece.placeAt(piece.restsFrom());
  EXPECT_TRUE(FallingPiece::mayReach(scene.broken.front(), size, end, 1.0));
  EXPECT_FALSE(FallingPiece::mayReach(scene.broken.front(), size, Vec3(9000.0, 0.0, 0.0), 1.0));
}

}  // namespace
}  // namespace vegetation_sim::forest

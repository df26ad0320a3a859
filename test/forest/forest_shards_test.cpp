// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A forest in shards: one world, whose trees have the bits that they have in one forest.
#include <gtest/gtest.h>

#include <set>

#include "core/error_text.h"
#include "scenes/forest/shard_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr int TICKS = 600;

Settings shardSettings() {
  Settings out;
  out.fixed_level = 3;
  out.budget.modal_trees = 0;  // modes start one tree per tick and shard, which is a limit
  return out;
}

wind::Field gustyWind() {
  wind::Primitive breeze = makeBreeze(1, Vec3(3.0, 1.5, 0.0));
  breeze.turbulence = 0.4;
  return wind::Field({breeze, makeDisk(2, Vec3(2.0, 1.0, 0.0), 5.0, Vec3(2.0, -1.0, 0.0))}, 4);
}

// A cart that drives around the origin at 0.72 m/s, along three sides of a square, over all
// borders.
Body cartAt(int tick, Nanoseconds stamp) {
  constexpr double SPEED = 0.72, HALF = 1.2;
  const Vec3 corners[] = {Vec3(-HALF, -HALF, 0.5), Vec3(HALF, -HALF, 0.5), Vec3(HALF, HALF, 0.5)};
  const Vec3 ways[] = {Vec3(SPEED, 0.0, 0.0), Vec3(0.0, SPEED, 0.0), Vec3(-SPEED, 0.0, 0.0)};
  Body out;
  out.id = "cart";
  out.frame = "cart";
  out.shape = Shape::BOX;
  out.size = Vec3(0.8, 0.5, 0.9);
  const double t = static_cast<double>(tick) / TICK_RATE, side = 2.0 * HALF / SPEED;
  const auto leg = static_cast<std::size_t>(std::min(2.0, t / side));
  out.velocity = ways[leg];
  out.pose.position = corners[leg] + (t - side * static_cast<double>(leg)) * out.velocity;
  out.stamp = stamp;
  return out;
}

Grab grabOf(const Forest& forest, std::uint32_t tree, double lease) {
  const Tree grown = growTree(forest.layout(), tree, forest.terrain());
  const int branch = grown.skeleton.depth_end[1] - 1;
  Grab out;
  out.point = {tree, branch, grown.skeleton.branches[static_cast<std::size_t>(branch)].length};
  const Pose pose =
      forest.pose(grown, tree, forest.snapshot().stamp)[static_cast<std::size_t>(branch)];
  out.target = grown.foot + pose.position + out.point.along * axisZ(pose.orientation);
  out.lease = lease;
  return out;
}

// What happens at a tick, with all requests made from the state of `whole`, the forest in one
// piece.
void act(int tick, Nanoseconds next, const Forest& whole, ShardedForest& world) {
  const auto hold = [&](const char* name, std::uint32_t tree, double lease) {
    world.grab(name, grabOf(whole, tree, lease));
  };
  world.all([&](Forest& shard) { shard.setBody(cartAt(tick, next)); });
  if (tick == 20) hold("first", 5, 0.0);
  if (tick == 33) hold("second", 30, 0.0);
  if (tick == 47) hold("leased", 16 + 64 + 9, 1.5);
  if (tick == 61) hold("third", 16 + 3 * 64 + 20, 0.0);
  if (tick > 61 && tick < 200 && tick % 3 == 0) {
    const auto pull = [&](const char* name, std::uint32_t tree) {
      world.move(name, grabOf(whole, tree, 0.0).target + Vec3(0.05, -0.04, 0.02));
    };
    pull("first", 5);
    pull("second", 30);
    pull("third", 16 + 3 * 64 + 20);
  }
  if (tick == 90) {
    Push push;
    push.point = grabOf(whole, 16 + 2 * 64 + 5, 0.0).point;
    push.force = Vec3(5.0, -8.0, 0.0);
    push.until = next + seconds(0.4);
    world.ownerOf(push.point.tree).push(push);
  }
  if (tick == 150) world.ownerOf(16 + 40).cut({16 + 40, 3});
  if (tick == 205) world.release("first");
  if (tick == 251) world.release("second");
  if (tick == 300) {
    wind::Primitive storm = makeBreeze(1, Vec3(-4.0, 2.0, 0.0));
    storm.turbulence = 0.5;
    world.all([&](Forest& shard) { shard.setWind(wind::Field({storm}, 5)); });
  }
  if (tick % 60 == 0)
    world.all([&](Forest& shard) {
      shard.setSensor({"lidar", Vec3(-4.0 + 0.01 * tick, 0.5, 1.0), 6.0, 0.01, next});
    });
}

::testing::AssertionResult haveEqualTrees(const ForestReplica& a, const ForestReplica& b,
                                          Nanoseconds stamp) {
  for (std::uint32_t id = 0; id < a.layout().treeCount(); ++id) {
    const auto differs = [&](const char* what) {
      return ::testing::AssertionFailure() << "tree " << id << ": " << what;
    };
    if (!(a.levelOf(id) == b.levelOf(id))) return differs("level");
    if (!(brokenOf(a.broken(), id) == brokenOf(b.broken(), id))) return differs("broken");
    const Tree tree = a.grow(id);
    const std::vector<Pose> here = a.pose(tree, id, stamp), there = b.pose(tree, id, stamp);
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Quat &q = here[i].orientation, &r = there[i].orientation;
      if (here[i].position != there[i].position || q.w != r.w || q.x != r.x || q.y != r.y ||
          q.z != r.z)
        return differs("pose");
    }
  }
  return ::testing::AssertionSuccess();
}

class ForestShards : public ::testing::TestWithParam<std::uint32_t> {};

// N6, N13: a body drives over the borders, trees on all sides are held, pushed and cut. The hashes
// of all shards add up to that of one forest at each tick, and a replica of all their messages has
// the bits of one that follows the whole forest.
TEST_P(ForestShards, AreOneWorld) {
  const Layout layout = fourTiles();
  ShardedForest whole(layout, shardSettings(), 1), world(layout, shardSettings(), GetParam());
  Forest& one = whole.shards()[0];
  ForestReplica of_one, of_all;
  for (ForestReplica* replica : {&of_one, &of_all}) replica->setLayout(one.layout(), flatTerrain());
  const TickGrid grid(TICK_RATE);
  const std::int64_t first = grid.tickAt(PHYSICS_START);
  for (ShardedForest* each : {&whole, &world})
    each->all([&](Forest& shard) {
      shard.setWind(gustyWind());
      shard.advance(grid.timeOf(first));
    });
  std::set<std::uint64_t> hashes;
  std::set<std::uint32_t> owners;
  for (int tick = 0; tick < TICKS; ++tick) {
    const Nanoseconds next = grid.timeOf(first + tick + 1);
    act(tick, next, one, world);
    act(tick, next, one, whole);
    for (ShardedForest* each : {&whole, &world})
      each->all([&](Forest& shard) { shard.advance(next); });
    ASSERT_EQ(world.treesHash(), one.treesHash()) << tick;
    hashes.insert(one.treesHash());
    for (const Reaction& reaction : one.reactions())
      if (reaction.kind == Reaction::CONTACT)
        owners.insert(world.shards()[0].owners().ownerOf(reaction.at.tree));
    const bool key_frame = tick % TICK_RATE == 0;
    of_one.setWind(one.snapshot().wind);
    of_all.setWind(one.snapshot().wind);
    ASSERT_TRUE(of_one.apply(one.update(key_frame))) << of_one.why();
    for (std::uint32_t i = 0; i < GetParam(); ++i) {
      Forest& shard = world.shards()[(i + static_cast<std::uint32_t>(tick)) % GetParam()];
      ASSERT_TRUE(of_all.apply(shard.update(key_frame))) << of_all.why();
    }
    ASSERT_EQ(of_all.stamp(), next);
    ASSERT_EQ(of_all.physicalTrees(), of_one.physicalTrees()) << tick;
    if (tick % 20 != 7) continue;
    ASSERT_TRUE(haveEqualTrees(of_one, of_all, next)) << tick;
  }
  EXPECT_EQ(hashes.size(), static_cast<std::size_t>(TICKS));
  EXPECT_EQ(owners.size(), GetParam()) << "the cart has to touch trees of all shards";
  EXPECT_EQ(one.broken().size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Counts, ForestShards, ::testing::Values(1u, 2u, 4u));

// Requests for trees of another shard are refused, and change nothing.
TEST(Shard, RefusesRequestsForTreesOfOthers) {
  const Layout layout = fourTiles();
  ShardedForest world(layout, shardSettings(), 2);
  world.all([](Forest& shard) { shard.advance(PHYSICS_START); });
  Forest& first = world.shards()[0];
  const std::uint32_t theirs = 16 + 3 * 64, ours = 16;
  ASSERT_EQ(first.owners().ownerOf(theirs), 1u);
  const std::uint64_t before = first.hash();
  const std::string why = "tree = 208 belongs to shard 1 of 2, this is shard 0";
  Grab grab = grabOf(first, theirs, 0.0);
  EXPECT_EQ(errorOf([&] { first.addGrab(grab); }), "grab: " + why);
  EXPECT_EQ(errorOf([&] {
              first.push({grab.point, Vec3(1, 0, 0), PHYSICS_START + 1});
            }),
            "push: " + why);
  EXPECT_EQ(errorOf([&] { first.cut({theirs, 1}); }), "cut: " + why);
  EXPECT_EQ(first.hash(), before);
  EXPECT_EQ(errorOf([&] { first.cut({ours, 1}); }), "");
}

// Grabs of all shards have different ids: a user of all shards can name one.
TEST(Shard, GrabsHaveIdsOfTheirShard) {
  ShardedForest world(fourTiles(), shardSettings(), 4);
  world.all([](Forest& shard) { shard.advance(PHYSICS_START); });
  std::set<std::uint32_t> ids;
  for (const std::uint32_t tree : {16u, 17u, 90u, 150u, 210u, 211u}) {
    const std::string name = std::to_string(tree);
    world.grab(name, grabOf(world.shards()[0], tree, 0.0));
    ids.insert(world.idOf(name));
    EXPECT_EQ((world.idOf(name) - 1) % 4, world.shards()[0].owners().ownerOf(tree));
  }
  EXPECT_EQ(ids.size(), 6u);
}

// N6: each kind of state of a tree is in the sum, and what all shards share is not.
TEST(Shard, TheSumOfHashesHasAllStateOfTrees) {
  ShardedForest whole(fourTiles(), shardSettings(), 1);
  Forest& forest = whole.shards()[0];
  forest.advance(PHYSICS_START);
  EXPECT_EQ(forest.treesHash(), 0u);
  std::set<std::uint64_t> seen{0};
  const auto expect_new = [&](const char* what) {
    EXPECT_TRUE(seen.insert(forest.treesHash()).second) << what;
  };
  const std::uint32_t id = forest.addGrab(grabOf(forest, 20, 0.0));
  expect_new("grab");
  forest.moveGrab(id, grabOf(forest, 20, 0.0).target + Vec3(0.0, 0.1, 0.0));
  expect_new("target");
  forest.push({grabOf(forest, 21, 0.0).point, Vec3(1, 0, 0), PHYSICS_START + seconds(1.0)});
  expect_new("push");
  forest.cut({22, 2});
  expect_new("cut");
  forest.advance(PHYSICS_START + seconds(1.0 / TICK_RATE));
  expect_new("joints");
  EXPECT_EQ(forest.broken().count(22), 1u);
  const std::uint64_t before = forest.treesHash();
  forest.setWind(gustyWind());
  forest.setBody(cartAt(0, PHYSICS_START));
  EXPECT_EQ(forest.treesHash(), before);
  EXPECT_THROW(Forest(fourTiles(), flatTerrain(), {}, Shard{7, 7}), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim::forest

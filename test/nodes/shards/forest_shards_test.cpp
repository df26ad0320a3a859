// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Two nodes that share a forest are one world: their hashes add up to that of a node with all
// trees, and a subscriber merges their messages.
#include <cstdlib>
#include <set>

#include "nodes/shards/shard_rig.h"

namespace vegetation_sim {
namespace {

TEST_F(ForestShardNodes, AreOneWorld) {
  const std::uint32_t first = treeOf(0), second = treeOf(1), third = treeOf(1, 1);
  const Vec3 left = limbOf(treeOf(0, 1)), right = limbOf(third);
  std::vector<HeldTwice> held;
  std::set<std::uint32_t> physical;  // trees
  for (int tick = 0; tick < 120; ++tick) {
    const Vec3 way(-1.2 + 0.02 * tick, 0.0, 0.1);
    nodes_->run(left + way, right + way);
    for (const std::uint32_t tree : nodes_->replica.replica().physicalTrees())
      physical.insert(tree);
    if (tick == 10) held.push_back(hold(second));
    if (tick == 17) held.push_back(hold(first));
    if (tick > 20 && tick < 50 && tick % 5 == 0)
      for (HeldTwice& grab : held) move(grab, Vec3(0.03, 0.0, -0.02));
    if (tick == 40) {
      ApplyForce::Request push;
      push.tree = third;
      push.branch = 0;
      push.along = 0.5;
      push.force.vector.x = 50.0;
      push.duration = 0.3;
      askBoth<ApplyForce>("apply_force", third, push);
    }
    if (tick == 55) {
      CutBranch::Request cut;
      cut.tree = first;
      cut.branch = static_cast<std::uint32_t>(limb(nodes_->replica.replica().grow(first))) + 1;
      askBoth<CutBranch>("cut_branch", first, cut);
    }
    if (tick == 70)
      for (const HeldTwice& grab : held) release(grab);
  }
  for (const std::uint32_t tree : {first, second, third, treeOf(0, 1)})
    EXPECT_EQ(physical.count(tree), 1u) << tree;
  ASSERT_GE(nodes_->whole_hashes.size(), 120u);
  std::size_t moving = 0;
  for (const auto& [stamp, hash] : nodes_->whole_hashes) {
    ASSERT_EQ(nodes_->sums[stamp], hash) << stamp;
    moving += hash != 0;
  }
  EXPECT_GT(moving, 100u);
  const Nanoseconds now = nodes_->settle();
  EXPECT_EQ(nodes_->replica.stateStatus(now).text, "In step: 2 shards");
  EXPECT_EQ(nodes_->replica.rivals(), "");
  const forest::ForestReplica &merged = nodes_->replica.replica(),
                              &whole = nodes_->whole_replica.replica();
  EXPECT_EQ(merged.physicalTrees(), whole.physicalTrees());
  EXPECT_EQ(merged.broken().count(first), 1u);  // has been cut; a hand may break others
  EXPECT_EQ(merged.broken(), whole.broken());
  for (std::uint32_t tree = 0; tree < merged.layout().treeCount(); ++tree) {
    const forest::Tree grown = merged.grow(tree);
    const std::vector<Pose> here = merged.pose(grown, tree, now),
                            there = whole.pose(grown, tree, now);
    for (std::size_t i = 0; i < here.size(); ++i)
      ASSERT_EQ(here[i].position, there[i].position) << tree << " " << i;
  }
}

// The last test, because a node ends: its trees stand still, and the subscriber names it.
TEST_F(ForestShardNodes, AShardThatDiesIsNamed) {
  ASSERT_EQ(std::system("rosnode kill /shard_1 > /dev/null"), 0);
  const Vec3 away(0.0, 0.0, 500.0);
  Nanoseconds now = 0;
  for (int tick = 0; tick < 150; ++tick) {
    nodes_->run(away, away, 1);
    now = nodes_->replica.replica().stampOf(0);
  }
  EXPECT_EQ(nodes_->replica.stateStatus(now).text,
            "Shard 1: No message for 3 s: drawn as it was then");
  EXPECT_TRUE(nodes_->replica.shardStatus(0, now).good);
  GetTree::Request theirs;
  theirs.tree = treeOf(1);
  EXPECT_EQ(nodes_->call<GetTree>("/shard_0", "get_tree", theirs).message,
            "shard 1 of 2, /shard_1, does not answer ~get_tree: it cannot be reached");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_shards_test");
  return RUN_ALL_TESTS();
}

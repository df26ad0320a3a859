// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest_replica.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds REPLICA_START = 1700000000LL * NANOSECONDS_PER_SECOND;

// Returns a key frame in which a branch of tree 0 is physical.
StateUpdate withPhysicalBranch(const ForestReplica& replica, int branch) {
  StateUpdate update;
  update.layout_hash = replica.layoutHash();
  update.stamp = REPLICA_START;
  update.trees = {{0, LevelState(), {{branch, {0.1, 0.1}, {}, NEVER}}, {}}};
  return update;
}

// A physical branch has no meaning in another layout, whose trees may have fewer branches.
TEST(ForestReplica, DropsPhysicalBranchesWhenTheLayoutChanges) {
  ForestReplica replica;
  replica.setLayout(gridLayout(4, 10.0), flatTerrain());
  const int last = static_cast<int>(replica.grow(0).skeleton.branches.size()) - 1;
  ASSERT_TRUE(replica.apply(withPhysicalBranch(replica, last))) << replica.why();
  ASSERT_EQ(replica.promoted(0).branches.size(), 1u);
  Layout bare = replica.layout();
  for (Species& species : bare.species) species.limbs.resize(1);
  replica.setLayout(bare, flatTerrain());
  EXPECT_TRUE(replica.promoted(0).branches.empty());
  const Tree tree = replica.grow(0);
  ASSERT_LT(tree.skeleton.branches.size(), static_cast<std::size_t>(last));
  EXPECT_EQ(replica.pose(tree, 0, REPLICA_START).size(), tree.skeleton.branches.size());
}

TEST(ForestReplica, RejectsAStateThatDoesNotFitItsLayout) {
  ForestReplica replica;
  replica.setLayout(gridLayout(4, 10.0), flatTerrain());
  const int count = static_cast<int>(replica.grow(0).skeleton.branches.size());
  EXPECT_EQ(errorOf([&] { replica.apply(withPhysicalBranch(replica, count)); }),
            "state: tree 0: branch " + std::to_string(count) + " is not below its " +
                std::to_string(count) + " branches");
  StateUpdate stranger = withPhysicalBranch(replica, 0);
  stranger.trees[0].tree = 16;
  EXPECT_EQ(errorOf([&] { replica.apply(stranger); }),
            "state: tree 16 is not below the 16 trees of the layout");
  EXPECT_TRUE(replica.physicalTrees().empty());
}

// Trees that have lost branches are counted, not grown: one key frame is enough for hundreds.
TEST(ForestReplica, OneKeyFrameIsEnoughForManyBrokenTrees) {
  ForestReplica replica;
  replica.setLayout(gridLayout(18, 10.0), flatTerrain());
  StateUpdate update = withPhysicalBranch(replica, 0);
  std::size_t branches = 0;
  for (std::uint32_t id = 0; id < replica.layout().treeCount(); ++id) {
    BrokenBranch broken;
    broken.stamp = REPLICA_START;
    const TreeSeed seed = seedOf(replica.layout(), id);
    const std::size_t count = countBranches(seed, replica.layout().species[seed.species]);
    broken.branch = static_cast<int>(count) - 1;
    branches += count;
    if (branches > 200000) break;
    update.trees.push_back({id, LevelState(), {}, {}, {broken}});
  }
  ASSERT_GT(branches, 2u * 65536u);
  update.trees.erase(update.trees.begin());
  EXPECT_TRUE(replica.apply(update)) << replica.why();
  EXPECT_EQ(replica.broken().size(), update.trees.size());
  update.trees[7].broken[0].branch += 1;
  EXPECT_THROW(replica.apply(update), InvalidInput);
}

// Returns a key frame of a shard of two that has no trees.
StateUpdate ofShard(const ForestReplica& replica, std::uint32_t shard) {
  StateUpdate update;
  update.layout_hash = replica.layoutHash();
  update.stamp = REPLICA_START;
  update.shard = shard;
  update.shards = 2;
  return update;
}

// A shard that loses a message waits for its next key frame; the others go on.
TEST(ForestReplica, TracksEachShard) {
  ForestReplica replica;
  replica.setLayout(gridLayout(4, 10.0), flatTerrain());
  StateUpdate first = ofShard(replica, 0), second = ofShard(replica, 1);
  second.base = LevelState::settled(3);
  ASSERT_TRUE(replica.apply(first));
  EXPECT_EQ(replica.stamp(), 0) << "the second shard has not begun";
  ASSERT_TRUE(replica.apply(second));
  EXPECT_EQ(replica.stamp(), REPLICA_START);
  const TreeOwners owners(replica.layout(), {0, 2});
  for (std::uint32_t tree = 0; tree < 16; ++tree)
    EXPECT_EQ(replica.levelOf(tree).level, owners.owns(tree) ? 0 : 3) << tree;
  first.key_frame = second.key_frame = false;
  first.sequence = 1;
  second.sequence = 2;
  first.stamp += NANOSECONDS_PER_SECOND;
  EXPECT_TRUE(replica.apply(first));
  EXPECT_FALSE(replica.apply(second));
  EXPECT_EQ(replica.why(), "messages were lost");
  EXPECT_TRUE(replica.isInStep(0));
  EXPECT_FALSE(replica.isInStep(1));
  EXPECT_EQ(replica.stampOf(0), first.stamp);
  EXPECT_EQ(replica.stamp(), REPLICA_START);
}

// Nodes that are started again with another number of shards are followed once the old ones are
// silent.
TEST(ForestReplica, FollowsAnotherNumberOfShardsAfterSilence) {
  ForestReplica replica;
  replica.setLayout(gridLayout(4, 10.0), flatTerrain());
  ASSERT_TRUE(replica.apply(ofShard(replica, 0)));
  StateUpdate update = ofShard(replica, 3);
  update.shards = 4;
  update.base = LevelState::settled(3);
  update.stamp += SHARD_SILENCE;
  EXPECT_THROW(replica.apply(update), InvalidInput);
  update.stamp += 1;
  ASSERT_TRUE(replica.apply(update)) << replica.why();
  EXPECT_EQ(replica.shards(), 4u);
  const TreeOwners owners(replica.layout(), {3, 4});
  for (std::uint32_t tree = 0; tree < 16; ++tree)
    EXPECT_EQ(replica.levelOf(tree).level, owners.owns(tree) ? 3 : 0) << tree;
  // A first message from a far time does not fix the number either.
  replica.forgetState();
  StateUpdate late = ofShard(replica, 0);
  late.stamp += 100 * SHARD_SILENCE;
  ASSERT_TRUE(replica.apply(late));
  EXPECT_TRUE(replica.apply(update));
  EXPECT_EQ(replica.shards(), 4u);
}

TEST(ForestReplica, RejectsShardsThatDoNotFit) {
  ForestReplica replica;
  replica.setLayout(gridLayout(4, 10.0), flatTerrain());
  ASSERT_TRUE(replica.apply(ofShard(replica, 0)));
  const auto fault_of = [&](std::uint32_t shard, std::uint32_t shards) {
    StateUpdate update = ofShard(replica, shard);
    update.shards = shards;
    return errorOf([&] { replica.apply(update); });
  };
  EXPECT_EQ(fault_of(1, 4), "state: shards = 4, but other messages have 2");
  EXPECT_EQ(fault_of(0, 0), "state: shards = 1, but other messages have 2");
  EXPECT_EQ(fault_of(2, 2), "shard: index = 2 is outside 0 to 1, because count = 2");
  const TreeOwners owners(replica.layout(), {1, 2});
  const std::uint32_t theirs = owners.owns(0) ? 0 : 15;
  StateUpdate update = ofShard(replica, 0);
  update.trees = {{theirs, LevelState::settled(2)}};
  EXPECT_EQ(errorOf([&] { replica.apply(update); }),
            "state: tree " + std::to_string(theirs) +
                " belongs to shard 1, but the message is of shard 0");
  EXPECT_TRUE(replica.isInStep(0));
  replica.forgetState();
  EXPECT_EQ(fault_of(1, 4), "") << "nothing is in step";
}

}  // namespace
}  // namespace vegetation_sim::forest

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_forest.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

ForestLayout twoByTwo() {
  ForestLayout out = toMsg(forest::gridLayout(2, 10.0));
  out.header.frame_id = "map";
  return out;
}

ForestState keyFrame(const SubscribedForest& forest, Nanoseconds stamp) {
  forest::StateUpdate out;
  out.layout_hash = forest.replica().layoutHash();
  out.stamp = stamp;
  out.base.level = 2;
  return toMsg(out);
}

TEST(SubscribedForest, SaysWhyItIsNotInStep) {
  SubscribedForest forest;
  forest.apply(keyFrame(forest, NANOSECONDS_PER_SECOND));
  EXPECT_EQ(forest.stateStatus(NANOSECONDS_PER_SECOND).text,
            "Waiting for a key frame: no layout yet");
  forest.setLayout(twoByTwo());
  EXPECT_EQ(forest.layouts(), 1);
  EXPECT_TRUE(forest.layoutStatus().good);
  forest.apply(keyFrame(forest, NANOSECONDS_PER_SECOND));
  EXPECT_TRUE(forest.stateStatus(NANOSECONDS_PER_SECOND).good)
      << forest.stateStatus(NANOSECONDS_PER_SECOND).text;
  EXPECT_FALSE(forest.stateStatus(NANOSECONDS_PER_SECOND + SILENCE + 1).good);
}

TEST(SubscribedForest, RejectedLayoutChangesNothing) {
  SubscribedForest forest;
  forest.setLayout(twoByTwo());
  const std::uint64_t hash = forest.replica().layoutHash();
  ForestLayout other = twoByTwo();
  other.terrain = "no_such_terrain.png";
  forest.setLayout(other);
  EXPECT_EQ(forest.replica().layoutHash(), hash);
  EXPECT_EQ(forest.layouts(), 1);
  EXPECT_FALSE(forest.layoutStatus().good);
}

// After a jump back in time all trees are at rest, until the next key frame.
TEST(SubscribedForest, ForgetsLaterStates) {
  SubscribedForest forest;
  forest.setLayout(twoByTwo());
  forest.apply(keyFrame(forest, 5 * NANOSECONDS_PER_SECOND));
  EXPECT_EQ(forest.replica().levelOf(0).level, 2);
  forest.forgetLater(5 * NANOSECONDS_PER_SECOND);
  EXPECT_EQ(forest.replica().levelOf(0).level, 2);
  forest.forgetLater(4 * NANOSECONDS_PER_SECOND);
  EXPECT_EQ(forest.replica().levelOf(0).level, 0);
  EXPECT_FALSE(forest.stateStatus(4 * NANOSECONDS_PER_SECOND).good);
  forest.apply(keyFrame(forest, 4 * NANOSECONDS_PER_SECOND));
  EXPECT_EQ(forest.replica().levelOf(0).level, 2);
}

// A shard that falls silent or loses a message is named; the others go on.
TEST(SubscribedForest, NamesTheShardThatIsNotInUse) {
  SubscribedForest forest;
  forest.setLayout(twoByTwo());
  const Nanoseconds start = 5 * NANOSECONDS_PER_SECOND;
  const auto of_shard = [&](std::uint32_t shard, Nanoseconds stamp) {
    ForestState out = keyFrame(forest, stamp);
    out.shard = shard;
    out.shards = 2;
    return out;
  };
  forest.apply(of_shard(0, start));
  EXPECT_EQ(forest.stateStatus(start).text, "Shard 1: No state: its plants are at rest");
  forest.apply(of_shard(1, start));
  EXPECT_EQ(forest.stateStatus(start).text, "In step: 2 shards");
  forest.setLayout(twoByTwo());  // by the other shard
  EXPECT_TRUE(forest.stateStatus(start).good);
  EXPECT_EQ(forest.layouts(), 1);
  const InputStatus usual = forest.layoutStatus();
  ForestLayout bad = twoByTwo();
  bad.species.clear();
  forest.setLayout(bad);
  EXPECT_FALSE(forest.layoutStatus().good);
  forest.setLayout(twoByTwo());
  EXPECT_EQ(forest.layoutStatus().text, usual.text);
  EXPECT_EQ(forest.layouts(), 1);
  const Nanoseconds later = start + 2 * SILENCE;
  forest.apply(of_shard(1, later));
  EXPECT_EQ(forest.stateStatus(later).text, "Shard 0: No message for 3 s: drawn as it was then");
  EXPECT_TRUE(forest.shardStatus(1, later).good);
  ForestState other = of_shard(1, later);
  other.shards = 3;
  forest.apply(other);
  EXPECT_EQ(forest.shardStatus(1, later).text,
            "Rejected a message: state: shards = 3, but other messages have 2");
}

}  // namespace
}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_meadow.h"

#include <gtest/gtest.h>

#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds MEADOW_START = 100 * NANOSECONDS_PER_SECOND;

GrassLayout smallMeadow() {
  grass::MapInput map;
  map.law = {2.0, -8.0, -8.0, 9, 9};
  map.height.value = 0.3;
  map.density.value = 100.0;
  grass::Layout layout;
  layout.map = std::make_shared<const grass::FeatureMap>(map);
  layout.terrain_hash = terrain::HeightMap().hash();
  GrassLayout out = toMsg(layout);
  out.header.frame_id = "map";
  return out;
}

/// Returns a key frame of a shard, of the ground within 20 m of the origin.
NearGrass nearGround(const SubscribedMeadow& meadow, std::uint32_t shard, std::uint32_t shards,
                     Nanoseconds stamp) {
  grass::TreadUpdate update;
  update.layout_hash = meadow.layout().hash();
  update.key_frame = true;
  update.stamp = stamp;
  update.shard = shard;
  update.shards = shards;
  NearGrass out;
  out.state = toMsg(update);
  out.discs.resize(1);
  out.discs[0].radius = 20.0;
  return out;
}

// The ground of a shard that does not run stands still, so that sensors need no other topic for it.
TEST(SubscribedMeadow, CoversTheGroundOfASilentShard) {
  SubscribedMeadow meadow;
  meadow.setLayout(smallMeadow());
  ASSERT_TRUE(meadow.ready()) << meadow.layoutStatus().text;
  const auto covers = [&](double x, Nanoseconds stamp) {
    return meadow.covers(Vec3(x, 0.0, 0.0), 5.0, stamp);
  };
  meadow.apply(nearGround(meadow, 0, 2, MEADOW_START));
  EXPECT_FALSE(covers(0.0, MEADOW_START)) << "shard 1 may begin";
  meadow.apply(nearGround(meadow, 1, 2, MEADOW_START));
  EXPECT_TRUE(covers(0.0, MEADOW_START));
  EXPECT_EQ(meadow.stamp(), MEADOW_START);
  const Nanoseconds late = MEADOW_START + SHARD_SILENCE;
  meadow.apply(nearGround(meadow, 0, 2, late));
  EXPECT_FALSE(covers(0.0, late)) << "shard 1 is late";
  meadow.apply(nearGround(meadow, 0, 2, late + 1));
  EXPECT_TRUE(covers(0.0, late + 1));
  EXPECT_FALSE(covers(18.0, late + 1));
  EXPECT_EQ(meadow.stamp(), late + 1);
  EXPECT_FALSE(meadow.stateStatus(late + 1).good);
}

TEST(SubscribedMeadow, CoversTheGroundOfAShardThatNeverBegan) {
  SubscribedMeadow meadow;
  meadow.setLayout(smallMeadow());
  meadow.apply(nearGround(meadow, 0, 2, MEADOW_START));
  EXPECT_EQ(meadow.stamp(), 0);
  const Nanoseconds late = MEADOW_START + SHARD_SILENCE + 1;
  meadow.apply(nearGround(meadow, 0, 2, late));
  EXPECT_EQ(meadow.stamp(), late);
  EXPECT_TRUE(meadow.covers(Vec3(0.0, 0.0, 0.0), 5.0, late));
}

// A shard that was without a link sends the ticks that it missed.
TEST(SubscribedMeadow, HearsTheOthersWhileAShardCatchesUp) {
  SubscribedMeadow meadow;
  meadow.setLayout(smallMeadow());
  for (std::uint32_t shard = 0; shard < 2; ++shard)
    meadow.apply(nearGround(meadow, shard, 2, MEADOW_START));
  const Nanoseconds late = MEADOW_START + 2 * SHARD_SILENCE;
  meadow.apply(nearGround(meadow, 0, 2, late));
  EXPECT_EQ(meadow.stamp(), late);
  meadow.apply(nearGround(meadow, 1, 2, MEADOW_START + 1));
  EXPECT_EQ(meadow.stamp(), late);
  meadow.apply(nearGround(meadow, 1, 2, late - 1));
  EXPECT_EQ(meadow.stamp(), late - 1);
  for (std::uint32_t shard = 0; shard < 2; ++shard)  // the clock jumps back
    meadow.apply(nearGround(meadow, shard, 2, MEADOW_START));
  EXPECT_EQ(meadow.stamp(), MEADOW_START);
}

// Nodes that are started again with another number of shards are followed once the old ones are
// silent.
TEST(SubscribedMeadow, FollowsAnotherNumberOfShardsAfterSilence) {
  SubscribedMeadow meadow;
  meadow.setLayout(smallMeadow());
  for (std::uint32_t shard = 0; shard < 4; ++shard)
    meadow.apply(nearGround(meadow, shard, 4, MEADOW_START));
  meadow.apply(nearGround(meadow, 0, 2, MEADOW_START + 1));
  EXPECT_EQ(meadow.stateStatus(MEADOW_START).text,
            "Shard 0: Rejected a message: state: shards = 2, but other messages have 4");
  const Nanoseconds late = MEADOW_START + SHARD_SILENCE + 1;
  for (std::uint32_t shard = 0; shard < 2; ++shard)
    meadow.apply(nearGround(meadow, shard, 2, late));
  EXPECT_EQ(meadow.stateStatus(late).text, "In step: 2 shards");
  EXPECT_EQ(meadow.stamp(), late);
}

}  // namespace
}  // namespace vegetation_sim

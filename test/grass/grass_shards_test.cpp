// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A meadow in shards against one in one piece: sources that cross the borders of shards, cuts whose
// swath lies beyond them, raised grass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "core/error_text.h"
#include "grass/map/tile_owners.h"
#include "grass/tread_simulation.h"

namespace vegetation_sim::grass {
namespace {

constexpr int TICKS = 150;
constexpr int TILES = 12;  // along each side
constexpr double SIDE = 2.0 * TILES;

MapLaw smallMap() {
  MapLaw out;
  out.columns = out.rows = TILES + 1;
  return out;
}

Layout layoutOf(const MapLaw& law) {
  MapInput input;
  input.law = law;
  Layout out;
  out.map = std::make_shared<const FeatureMap>(input);
  return out;
}

/// One meadow in `count` shards, which all take all inputs, and a replica of it.
class ShardedMeadow {
 public:
  explicit ShardedMeadow(std::uint32_t count) {
    for (std::uint32_t index = 0; index < count; ++index) {
      maps_.push_back(std::make_unique<TreadMap>(
          law_, TreadSettings(), std::make_shared<const TileOwners>(law_, Shard{index, count})));
      shards.emplace_back(layoutOf(law_), std::make_shared<const terrain::HeightMap>(),
                          TreadSettings(), *maps_.back());
    }
  }
  /// Ends a tick, and passes the updates on to the replica; of key frames it sums the hashes.
  void advance(Nanoseconds stamp, bool key_frame) {
    hash = entered = 0;
    for (TreadSimulation& shard : shards) {
      entered += shard.advance(stamp).size();
      const TreadUpdate update = shard.update(key_frame);
      hash += update.hash;
      EXPECT_TRUE(replica.apply(update, merged)) << replica.why();
    }
  }
  std::uint64_t mergedHash(Nanoseconds stamp) const {
    TreadDelta all = snapshotTreads(merged.state(), stamp);
    all.cuts = snapshotCuts(merged.cuts().state());
    return hashOf(all);
  }
  std::size_t blocks() const {
    std::size_t out = 0;
    for (const auto& map : maps_) out += map->state().blocks.size();
    return out;
  }
  const TreadMap& map(std::size_t shard) const { return *maps_[shard]; }

 private:
  MapLaw law_{smallMap()};
  std::vector<std::unique_ptr<TreadMap>> maps_;

 public:
  std::vector<TreadSimulation> shards;
  TreadMap merged{law_, TreadSettings()};
  TreadReplica replica;
  std::uint64_t hash{0};
  std::size_t entered{0};
};

TreadInput walk(int walker, int tick) {
  TreadInput out;
  out.source = "walker_" + std::to_string(walker);
  out.body_frame = out.source;
  const double t = 0.05 * tick + walker;
  out.position = Vec3(0.5 * SIDE + 0.49 * SIDE * std::sin(0.9 * t + walker),
                      0.5 * SIDE + 0.49 * SIDE * std::sin(0.7 * t + 2.0 * walker), 0.0);
  out.law.reach = walker == 0 ? 2.5 : 0.35;
  out.law.radius = walker == 0 ? 1.0 : 0.12;
  out.law.recovery = walker == 1 ? 1.5 : 60.0;
  return out;
}

void act(ShardedMeadow& meadow, int tick, Nanoseconds stamp) {
  for (TreadSimulation& shard : meadow.shards) {
    for (int walker = 0; walker < 5; ++walker) shard.apply(walk(walker, tick), stamp);
    if (tick == 20) {
      TreadInput stroke = walk(7, 0);
      stroke.action = TreadAction::STROKE;
      stroke.start = Vec3(-1.0, 3.0, 0.0);
      stroke.position = Vec3(SIDE + 1.0, SIDE - 2.0, 0.0);
      shard.apply(stroke, stamp);
    }
    // Each is laid on the other, so that the second depends on the first.
    if (tick == 30 || tick == 40) {
      const double y = tick == 30 ? 6.0 : 10.0;
      CutArea area;
      area.outline = {{2.0, y}, {SIDE - 2.0, y}};
      area.radius = 3.0;
      area.height = tick == 30 ? 0.2 : 0.1;
      area.swath = {{1.0, 7.0}, {SIDE - 1.0, 7.0}, {SIDE - 1.0, 17.0}, {1.0, 17.0}};
      shard.cut(area);
    }
    if (tick == 90) shard.raise({0.5 * SIDE, 0.5 * SIDE}, 4.0);
    if (tick == 120) shard.raiseAll();
  }
}

TEST(GrassShards, AreOneMeadow) {
  ShardedMeadow whole(1);
  std::list<ShardedMeadow> divided;
  for (const std::uint32_t count : {2u, 3u, 4u}) divided.emplace_back(count);
  std::size_t trodden = 0;
  for (int tick = 1; tick <= TICKS; ++tick) {
    const Nanoseconds stamp = NANOSECONDS_PER_SECOND + tick * NANOSECONDS_PER_SECOND / 30;
    const bool key_frame = tick % 10 == 1;
    act(whole, tick, stamp);
    whole.advance(stamp, key_frame);
    trodden = std::max(trodden, whole.blocks());
    for (ShardedMeadow& meadow : divided) {
      act(meadow, tick, stamp);
      meadow.advance(stamp, key_frame);
      ASSERT_EQ(meadow.hash, whole.hash) << tick << ", shards " << meadow.shards.size();
      ASSERT_EQ(meadow.mergedHash(stamp), whole.mergedHash(stamp)) << tick;
      ASSERT_EQ(meadow.blocks(), whole.blocks()) << tick;
      ASSERT_EQ(meadow.entered, whole.entered) << tick;
    }
    // Each drag is reported by one shard, with the same value.
    for (const Drag& drag : whole.shards[0].drags()) {
      std::size_t found = 0;
      for (const TreadSimulation& shard : divided.back().shards)
        for (const Drag& other : shard.drags())
          if (other.source == drag.source) {
            ++found;
            ASSERT_EQ(other.force, drag.force) << tick << " " << drag.source;
          }
      ASSERT_EQ(found, 1u) << tick << " " << drag.source;
    }
  }
  EXPECT_GT(trodden, 200u);
  for (std::size_t shard = 0; shard < 4; ++shard)  // each has had its part
    EXPECT_GT(divided.back().map(shard).state().counts.strokes, 20u) << shard;
}

TEST(GrassShards, OwnAboutEqualConnectedShares) {
  for (const std::uint32_t count : {1u, 2u, 3u, 7u}) {
    std::vector<int> owned(count);
    const TileOwners owners(smallMap(), {0, count});
    for (int row = 0; row < TILES; ++row)
      for (int column = 0; column < TILES; ++column) ++owned[owners.ownerOf(column, row)];
    for (const int tiles : owned)
      EXPECT_NEAR(tiles, TILES * TILES / static_cast<double>(count), 1.0) << count;
    EXPECT_EQ(owners.ownerAt(-5.0, -5.0), owners.ownerOf(0, 0));
    EXPECT_EQ(owners.ownerAt(3.9, 4.1), owners.ownerOf(1, 2));
    EXPECT_EQ(owners.ownerAt(1e9, 1e9), owners.ownerOf(TILES - 1, TILES - 1));
    EXPECT_EQ(owners.ownerAt(std::nan(""), 0.0), owners.ownerOf(0, 0));
  }
  EXPECT_EQ(errorOf([] {
              TileOwners(smallMap(), {2, 2});
            }),
            "shard: index = 2 is outside 0 to 1, because count = 2");
}

TEST(GrassShards, ReplicaRefusesOtherCountsAndBlocksOfOthers) {
  ShardedMeadow meadow(2);
  act(meadow, 20, NANOSECONDS_PER_SECOND);
  meadow.advance(NANOSECONDS_PER_SECOND, true);
  TreadUpdate update = meadow.shards[0].update(true);
  ASSERT_FALSE(update.treads.blocks.empty());
  update.shards = 3;
  EXPECT_EQ(errorOf([&] { meadow.replica.apply(update, meadow.merged); }),
            "state: shards = 3, but other messages have 2");
  update.shards = 2;
  update.shard = 1;
  const TreadBlockDelta& block = update.treads.blocks.front();
  EXPECT_EQ(errorOf([&] { meadow.replica.apply(update, meadow.merged); }),
            "state: block " + std::to_string(block.row) + ", " + std::to_string(block.column) +
                " belongs to shard 0, but the message is of shard 1");
}

// A shard that misses a message waits for its key frame; the other goes on.
TEST(GrassShards, ReplicaFollowsTheSequenceOfEachShard) {
  ShardedMeadow meadow(2);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  meadow.advance(stamp, true);
  meadow.shards[0].update(false);  // lost
  stamp += NANOSECONDS_PER_SECOND;
  for (TreadSimulation& shard : meadow.shards) shard.advance(stamp);
  EXPECT_FALSE(meadow.replica.apply(meadow.shards[0].update(false), meadow.merged));
  EXPECT_EQ(meadow.replica.why(), "messages were lost");
  EXPECT_TRUE(meadow.replica.apply(meadow.shards[1].update(false), meadow.merged));
  EXPECT_EQ(meadow.replica.stampOf(0), NANOSECONDS_PER_SECOND);
  EXPECT_EQ(meadow.replica.stampOf(1), stamp);
  EXPECT_TRUE(meadow.replica.apply(meadow.shards[0].update(true), meadow.merged));
}

}  // namespace
}  // namespace vegetation_sim::grass

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Maximum number of processes that share a landscape: as many requests go to all of them at once.
constexpr std::uint32_t MOST_SHARDS = 256;
/// A shard that is silent for longer stands still for others, and no longer says how many there
/// are.
constexpr Nanoseconds SHARD_SILENCE = 3 * NANOSECONDS_PER_SECOND;

/// The share of a landscape that one process animates. Of a count of 1 it is all of it.
struct Shard {
  std::uint32_t index{0};  ///< below `count`
  std::uint32_t count{1};  ///< 1 to MOST_SHARDS
};

/// Whether a shard that was last heard at `last` is silent at a stamp. A `last` that is as much
/// later is a stamp of another run of the clock.
inline bool isSilentShard(Nanoseconds last, Nanoseconds stamp) {
  return stamp - last > SHARD_SILENCE || last - stamp > SHARD_SILENCE;
}

/// Adds a fault for each number out of range.
void check(const Shard& shard, Faults& faults);
/// Returns the smallest id from `least` (above 0) on that the shard may give, so that all shards
/// give different ones: index + 1 and each `count` after it.
std::uint32_t nextIdOf(const Shard& shard, std::uint32_t least);
/// Returns the shard that gives this id (above 0).
std::uint32_t shardOfId(std::uint32_t id, std::uint32_t count);

/// A unit, such as a tile, is owned by one shard as a whole.
struct ShardUnit {
  double x, y;           ///< its middle [m]
  std::uint32_t weight;  ///< share of the work
};
/// Returns the owner of each unit: a pure function, so that all processes agree. Units lie in a row
/// along a Morton curve through their middles, equal ones in their order here; shards have
/// successive stretches of it of about equal weight. A unit belongs to the shard into whose stretch
/// its middle falls.
std::vector<std::uint16_t> assignShards(const std::vector<ShardUnit>& units, std::uint32_t count);

}  // namespace vegetation_sim

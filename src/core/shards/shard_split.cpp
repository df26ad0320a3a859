// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/shards/shard_split.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/math/morton.h"

namespace vegetation_sim {
void check(const Shard& shard, Faults& faults) {
  if (shard.count < 1 || shard.count > MOST_SHARDS)
    faults.add("shard: count = " + std::to_string(shard.count) + " is outside 1 to " +
               std::to_string(MOST_SHARDS));
  else if (shard.index >= shard.count)
    faults.add("shard: index = " + std::to_string(shard.index) + " is outside 0 to " +
               std::to_string(shard.count - 1) +
               ", because count = " + std::to_string(shard.count));
}

std::uint32_t nextIdOf(const Shard& shard, std::uint32_t least) {
  const std::uint32_t over = shardOfId(least, shard.count);
  return least + (shard.index + shard.count - over) % shard.count;
}

std::uint32_t shardOfId(std::uint32_t id, std::uint32_t count) {
  return (id - 1) % count;
}

std::vector<std::uint16_t> assignShards(const std::vector<ShardUnit>& units, std::uint32_t count) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> row;  // key and index
  row.reserve(units.size());
  std::uint64_t twice_all = 0;
  for (const ShardUnit& unit : units) {
    row.emplace_back(mortonKey(unit.x, unit.y), static_cast<std::uint32_t>(row.size()));
    twice_all += 2 * std::uint64_t{unit.weight};
  }
  std::sort(row.begin(), row.end());
  std::vector<std::uint16_t> out(units.size());
  std::uint64_t before = 0;
  for (const auto& [key, index] : row) {
    const std::uint64_t middle = 2 * before + units[index].weight;
    out[index] = static_cast<std::uint16_t>(
        std::min<std::uint64_t>(middle * count / std::max<std::uint64_t>(1, twice_all), count - 1));
    before += units[index].weight;
  }
  return out;
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CrowdBorder.h>

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "core/config/shard.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The borders that the other shards of a crowd have sent, until their ticks. A shard may be one
/// tick ahead, and the first message from it may come then, so that each holds two borders.
class WaitingBorders {
 public:
  /// Expects each of the other shards.
  explicit WaitingBorders(const Shard& shard);

  /// Keeps the borders of a message that are newer than those which its shard has sent. Those of
  /// this shard, of unknown shards and of another number of shards are ignored.
  void add(const CrowdBorder& message);
  /// Whether each expected shard has sent the border after the tick at `before`, or a later one.
  bool hasAll(Nanoseconds before) const;
  /// Expects the others no longer until they send again. Returns their number.
  std::size_t dropLate(Nanoseconds before);
  /// Returns the newest border of each shard that is earlier than the tick `now`, by rising shard.
  std::vector<CrowdBorder> take(Nanoseconds now);

 private:
  Shard shard_;
  std::map<std::uint32_t, std::vector<CrowdBorder>> waiting_;  // by shard, by rising stamp
  std::map<std::uint32_t, Nanoseconds> newest_;                // stamps by shard
  std::set<std::uint32_t> expected_;                           // shards
};

}  // namespace vegetation_sim

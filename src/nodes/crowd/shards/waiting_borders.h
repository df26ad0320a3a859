// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CrowdBorder.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/shards/shard_split.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The borders that the other shards of a crowd have sent, until their ticks. A shard may be one
/// tick ahead, and the first message from it may come then, so that each holds two borders. When
/// the clock jumps back, the other shards may see it before this one or after.
class WaitingBorders {
 public:
  static constexpr double MOST_AHEAD = 10.0;  ///< of a border, after the tick that waits [s]
  static constexpr std::size_t MOST_BYTES = 256'000'000;  ///< of all borders that wait

  /// Expects each of the other shards.
  explicit WaitingBorders(const Shard& shard, std::size_t most_bytes = MOST_BYTES);

  /// Begins to wait for the tick `now`. @param before stamp of the tick before; 0: there was none.
  void beginTick(Nanoseconds before, Nanoseconds now);
  /// Keeps the borders of a message that are newer than those which its shard has sent. Those of
  /// this shard, of unknown shards, of another number of shards, and stamped more than
  /// MOST_AHEAD after the tick are ignored. An older one replaces those that are not older: if
  /// it is earlier than the tick before, at the next jump of the clock. A message of more
  /// than `most_bytes` is dropped; of more in all, the oldest border of the shard with most bytes.
  void add(const CrowdBorder& message);
  /// Whether each expected shard has sent the border after the tick before, or a later one.
  bool hasAll() const;
  /// Expects the others no longer until they send again. Returns their number.
  std::size_t dropLate();
  /// Whether a shard has sent the border after a later tick: it has run before this one.
  bool isAnyAhead() const;
  /// Whether a border of a shard has come.
  bool hasSent(std::uint32_t shard) const { return sent_.count(shard) > 0; }
  /// Returns the newest border of each shard that is earlier than the tick, by rising shard.
  std::vector<CrowdBorder> take();
  /// Expects the borders from after a jump back of the clock instead.
  void jumpBack();
  /// Number of borders and messages that were dropped for their size.
  std::uint64_t dropped() const { return dropped_; }

 private:
  /// Borders that a shard has sent.
  struct Sent {
    std::vector<CrowdBorder> waiting;     // by rising stamp
    std::vector<CrowdBorder> after_jump;  // that this node has not seen yet
    std::optional<Nanoseconds> newest;    // stamp
    bool has_to_jump{false};              // newer ones are from before the jump
  };
  bool hasCome(std::uint32_t shard) const;
  bool dropOneTooMany();

  Shard shard_;
  std::size_t most_bytes_;
  Nanoseconds before_{0}, now_{0};
  std::map<std::uint32_t, Sent> sent_;  // by shard
  std::set<std::uint32_t> expected_;    // shards
  std::uint64_t dropped_{0};
};

}  // namespace vegetation_sim

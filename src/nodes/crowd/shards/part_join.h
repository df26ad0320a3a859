// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/AgentState.h>
#include <vegetation_sim/CrowdPart.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The people of all shards at a tick.
struct JoinedPeople {
  Nanoseconds stamp{0};
  std::uint64_t hash{0};           // sum over the shards
  std::vector<AgentState> agents;  // by rising id
};

/// @throws InvalidInput for invalid people, and for a shard that shard 0 of `shards` does not hear.
void check(const CrowdPart& part, std::uint32_t shards);

/// Joins the people of the shards of a crowd. Those of a tick are complete once the parts of all
/// shards have come. Shards that are silent and parts that come later than LONGEST_WAIT are not
/// awaited: their people stand as they were last.
class PartJoin {
 public:
  static constexpr double LONGEST_WAIT = 0.5;  ///< [s]; a lost packet comes again after 0.2 or more

  /// @param shards number of shards. @param own the one that joins: its ticks tell the time.
  PartJoin(std::uint32_t shards, std::uint32_t own) : shards_(shards), own_(own) {}

  /// Sets the stamp of the last tick of this node; 0: there was none.
  void setTime(Nanoseconds last) { last_tick_ = last; }
  /// Keeps a part until its tick. Each shard sends its parts in order.
  void add(const CrowdPart& part);
  /// Returns the people of the earliest tick, each once, if it is complete.
  std::optional<JoinedPeople> take();
  /// Forgets all from before a jump back of the clock, also what is still on its way.
  void jumpBack();
  /// Stamp of the people returned last; 0: none.
  Nanoseconds stamp() const { return joined_; }
  /// Number of parts that came after the people of their tick had been returned.
  std::uint64_t late() const { return late_; }

 private:
  using Parts = std::map<std::uint32_t, CrowdPart>;  // by shard
  bool isFromBeforeJump(std::uint32_t shard, Nanoseconds stamp);
  void addLate(const CrowdPart& part);
  bool hasAll(Nanoseconds stamp, const Parts& parts) const;
  const CrowdPart* findPart(std::uint32_t shard) const;
  std::vector<AgentState> peopleOf(const std::set<std::uint32_t>& fresh, const Parts& before) const;

  std::uint32_t shards_, own_;
  Nanoseconds last_tick_{0}, joined_{0};
  std::map<Nanoseconds, Parts> waiting_;              // by stamp, that wait for other shards
  Parts last_;                                        // of the people returned last
  std::map<std::uint32_t, Nanoseconds> heard_;        // stamp of the newest part of each shard
  std::map<std::uint32_t, Nanoseconds> running_;      // stamp of the last tick that heard a shard
  std::map<std::uint32_t, Nanoseconds> before_jump_;  // heard_ of shards that have not jumped yet
  std::uint64_t late_{0};
};

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "crowd/agents/crowd_owners.h"

namespace vegetation_sim::crowd {

/// What one shard of a crowd tells the others after a tick.
struct CrowdBorder {
  /// A person who has crossed the border, with all of the state.
  struct Handed {
    std::uint32_t to{0};  ///< shard
    Walker walker;
  };
  Nanoseconds stamp{0};        ///< of the tick
  std::vector<Walker> near;    ///< those whom people of other shards may see, by rising id
  std::vector<Handed> handed;  ///< also in `near`
};

/// The part of a crowd that lives in the region of one shard. People see those of other shards near
/// the border, as these were after the last tick, and change the shard with the tick in which they
/// cross the border. So all shards together do what one crowd does, if each has the borders of all
/// others after each tick. Differences come only from searches for ways around walls, whose limits
/// and starts are those of each shard.
class CrowdShard {
 public:
  /// @param crowd must outlive it; holds the people of the region only.
  CrowdShard(Crowd& crowd, const Shard& shard)
      : crowd_(crowd), owners_(crowd.snapshot().area, shard) {}

  const CrowdOwners& owners() const { return owners_; }
  /// Removes the people who have left the region, and returns what the others need. To be called
  /// once before the first tick, and after each.
  CrowdBorder endTick();
  /// Takes in people who come, and shows those of others. To be called before Crowd::advance().
  /// @param others the newest borders of the other shards.
  void beginTick(const std::vector<CrowdBorder>& others);

 private:
  Crowd& crowd_;
  CrowdOwners owners_;
  std::vector<Walker> left_;  // after the last tick
};

/// People as bytes, and back. @throws InvalidInput for bytes that are no people.
std::string archivePeople(std::vector<Walker> people);
std::vector<Walker> readPeople(std::string bytes);

}  // namespace vegetation_sim::crowd

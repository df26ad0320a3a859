// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "crowd/agents/crowd_owners.h"

namespace vegetation_sim::crowd {

/// State that one shard of a crowd sends to the others after a tick.
struct CrowdBorder {
  /// A person beyond the border now, with all of the state.
  struct Handed {
    std::uint32_t to{0};   ///< shard
    Nanoseconds stamp{0};  ///< of the tick in which the person has crossed it
    Walker walker;
  };
  Nanoseconds stamp{0};        ///< of the tick
  std::vector<Walker> near;    ///< those whom people of other shards may see, by rising id
  std::vector<Handed> handed;  ///< until their new shard has heard of them
  std::map<std::uint32_t, Nanoseconds> heard;  ///< stamps of the newest borders of other shards
};

/// The part of a crowd that lives in the region of one shard. People see those of other shards near
/// the border, as these were after the last tick, and change the shard with the tick in which they
/// cross the border. So all shards together do what one crowd does, if each has the borders of all
/// others after each tick. Differences come only from searches for ways around walls, whose limits
/// and starts are those of each shard. People who come to a shard that is silent wait for it.
class CrowdShard {
 public:
  /// @param crowd must outlive it; holds the people of the region only.
  CrowdShard(Crowd& crowd, const Shard& shard)
      : crowd_(&crowd), owners_(crowd.snapshot().area, shard) {}

  const CrowdOwners& owners() const { return owners_; }
  /// Removes the people who have left the region, and returns what the others need. To be called
  /// once before the first tick, and after each.
  CrowdBorder endTick();
  /// Takes the border of another shard, and in those who come from there. One that is not newer
  /// than the last is ignored. @throws InvalidInput for another shard than there are.
  void hear(std::uint32_t shard, CrowdBorder border);
  /// Shows people those of others. To be called before Crowd::advance().
  void beginTick();
  /// Forgets what others have said, because the crowd starts anew.
  void clear();
  /// Number of people who wait for another shard.
  std::size_t waiting() const { return handed_.size(); }

  /// State besides the crowd's.
  void archive(Archive& a);

 private:
  Crowd* crowd_;
  CrowdOwners owners_;
  std::map<std::uint32_t, CrowdBorder> borders_;  // of other shards, the newest
  std::vector<CrowdBorder::Handed> handed_;
  std::vector<Walker> left_;  // after the last tick
};

/// A border as bytes, and back. @throws InvalidInput for bytes that are no border.
std::string archiveBorder(CrowdBorder border);
CrowdBorder readBorder(std::string bytes);

}  // namespace vegetation_sim::crowd

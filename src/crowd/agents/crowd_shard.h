// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
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
  std::uint32_t run{0};  ///< how often the crowd was reset; of an earlier run it counts no longer
  /// Stamp of the first tick since the shard started; 0: before it, or the shard has loaded a
  /// state.
  Nanoseconds begun{0};
  bool starts{false};              ///< the shard has started while others run, and asks for `ids`
  bool lists{false};               ///< `ids` are given
  std::vector<std::uint32_t> ids;  ///< of the shard's people, and of those in `handed`
};

/// The part of a crowd that lives in the region of one shard. People see those of other shards near
/// the border, as these were after the last tick, and change the shard with the tick in which they
/// cross the border. So all shards together do what one crowd does, if each has the borders of all
/// others after each tick. Differences come only from searches for ways around walls, whose limits
/// and starts are those of each shard. People who come to a shard that is silent stand and wait.
class CrowdShard {
 public:
  /// Time for which a shard that has started waits for the lists of the others [s].
  static constexpr double LONGEST_START = 2.0;
  /// How the crowd has come to be: at the start of the node or of the clock, when others may run
  /// already, or by a reset, which is one in all shards.
  enum class Start { FRESH, RESET };

  /// @param crowd must outlive it; holds the people of the region only.
  CrowdShard(Crowd& crowd, const Shard& shard)
      : crowd_(&crowd), owners_(crowd.snapshot().area, shard) {}

  const CrowdOwners& owners() const { return owners_; }
  /// Begins with a crowd that has all people at their starts. Removes those of other regions,
  /// forgets what others have said, and returns what they need.
  CrowdBorder begin(Start start);
  /// Number of resets, and sets it.
  std::uint32_t run() const { return run_; }
  void setRun(std::uint32_t run) { run_ = run; }
  /// Whether the crowd has to begin anew before hear(), since the sender has been reset more often.
  bool isResetBy(const CrowdBorder& border) const { return border.run > run_ && !isStarting(); }
  /// Removes the people who have left the region, and returns what the others need. To be called
  /// after each tick.
  CrowdBorder endTick();
  /// Takes the border of another shard, and in those who come from there. One that is not newer
  /// than the last, or from before a reset, is ignored. If this shard hears a tick of the other for
  /// the first time and has started later, it removes all people, until spawnMissing(), since the
  /// other may have them. Returns the number of those from there for whom there is no room here,
  /// and who are lost. @throws InvalidInput for another shard than there are.
  std::size_t hear(std::uint32_t shard, CrowdBorder border);
  /// Does the same before the first tick, if another shard is known to have run before.
  void startBesideOthers();
  /// Whether the shard has no people yet, since others have not listed theirs.
  bool asksOthers() const { return starts_; }
  /// If the shard has started while others run, and these have listed their people since: spawns
  /// those whom none of them has, and returns their number. Of several shards that start, the first
  /// spawns those whose start is in the region of one that runs. If one is silent for
  /// LONGEST_START, only those whose start is here. To be called before beginTick(). @param spawns
  /// people by ids.
  std::optional<std::size_t> spawnMissing(const std::vector<Spawn>& spawns);
  /// Shows people those of others. To be called before Crowd::advance().
  void beginTick();
  /// People who are on the way to another shard.
  const std::vector<CrowdBorder::Handed>& handed() const { return handed_; }
  bool isHanded(std::uint32_t id) const { return findHanded(id) != handed_.end(); }
  /// Those of them who had not been taken in time at the last beginTick(): they stand where they
  /// have crossed the border.
  const std::vector<Walker>& waiting() const { return waiting_; }
  /// Those on the way who have not been removed, standing where they have crossed the border. A
  /// shard that is late may not show them yet.
  std::vector<Walker> standing() const;
  /// Removes a person on the way to another shard, before beginTick(): here if the person waits,
  /// otherwise the other shard does it.
  void removeHanded(std::uint32_t id);
  /// Whether the person is here, on the way to another shard, or could come from one at the next
  /// tick.
  bool mayHave(std::uint32_t id) const;

  /// State besides the crowd's.
  void archive(Archive& a);

 private:
  void removeAll();
  void forgetTaken(std::uint32_t shard, const CrowdBorder& border);
  std::size_t takeIn(std::uint32_t shard, const CrowdBorder& border);
  bool hasAnswered(std::uint32_t shard) const;
  /// Whether the person is here or on the way to another shard.
  bool has(std::uint32_t id) const;
  std::vector<CrowdBorder::Handed>::const_iterator findHanded(std::uint32_t id) const;
  bool isStarting() const { return fresh_ || starts_; }
  bool waits(const CrowdBorder::Handed& handed) const;

  Crowd* crowd_;
  CrowdOwners owners_;
  std::map<std::uint32_t, CrowdBorder> borders_;  // of other shards, the newest
  std::vector<CrowdBorder::Handed> handed_;
  std::vector<Walker> left_;   // after the last tick
  std::vector<Walker> start_;  // people of other regions at their starts, until the first tick
  std::vector<Walker> waiting_;
  std::set<std::uint32_t> removed_;  // those on the way whom their new shard removes
  Nanoseconds last_{0};              // stamp of the last tick
  std::uint32_t run_{0};
  bool fresh_{false};                 // no tick has run since the start
  bool starts_{false};                // until spawnMissing()
  std::optional<Nanoseconds> begun_;  // stamp of the first tick; 0: of a state that was loaded
  std::set<std::uint32_t> known_;     // shards whose ticks were heard since the start
  Nanoseconds asked_{0};              // stamp of the first border with `starts`; 0: none yet
};

/// A border as bytes, and back. @throws InvalidInput for bytes that are no border.
std::string archiveBorder(CrowdBorder border);
CrowdBorder readBorder(std::string bytes);

}  // namespace vegetation_sim::crowd

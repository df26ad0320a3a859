// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/threads/thread_pool.h"
#include "crowd/agents/walking_speed.h"
#include "crowd/geometry/ways.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::crowd {

/// Rectangle in which wandering walkers choose their goals [m].
struct Area {
  double min_x{-10.0}, max_x{10.0}, min_y{-10.0}, max_y{10.0};
};
void describe(FieldVisitor& visitor, Area& area);

/// State of a crowd: copy it to save, assign it to restore (N6). Obstacles, terrain and grass are
/// inputs; with equal inputs the continuation has the same bits.
struct CrowdSnapshot {
  Nanoseconds stamp{0};
  bool begun{false};  ///< `stamp` is valid
  std::uint64_t seed{0};
  CrowdSettings settings;
  Area area;
  std::vector<Walker> walkers;          ///< by rising id
  std::map<std::string, Robot> robots;  ///< by id
  std::uint32_t next_id{0};
  std::vector<WayProgress> ways;  ///< searches for ways around obstacles, the oldest first

  /// Leaves out `ways`, which change nothing but what walkers do.
  std::uint64_t hash() const;
  /// Sum modulo 2^64 of the hashes of the walkers; those of all shards add up to that of one crowd.
  std::uint64_t walkersHash() const;
};

class CrowdOwners;

/// Limits of a crowd.
constexpr std::size_t MOST_WALKERS = 100000, MOST_ROBOTS = 64;
/// Largest id of a walker; the next one is a number, too.
constexpr std::uint32_t LARGEST_ID = (1u << 31) - 1;

/// Walkers that perceive, decide and move (paper 2, section 5; S2-30). Inputs take effect at the
/// next tick. Each walker perceives the crowd as it was before the tick, so the result depends
/// neither on the order of the walkers nor on the number of threads. Not thread-safe.
class Crowd {
 public:
  /// @throws InvalidInput with all faults of the settings.
  Crowd(std::uint64_t seed, const CrowdSettings& settings, const Area& area,
        std::shared_ptr<const terrain::HeightMap> terrain);

  /// Replaces the trunks and walls.
  void setObstacles(std::vector<Obstacle> obstacles);
  /// Sets the resistance, which is called from several threads.
  void setResistance(Resistance resistance) { resistance_ = std::move(resistance); }
  void setThreads(int threads) { threads_ = std::make_shared<ThreadPool>(threads); }

  // The following throw InvalidInput with thing, value and range, and then change nothing.
  /// Spawns a walker with the next free id.
  std::uint32_t spawn(const Spawn& spawn) { return this->spawn(spawn, memory_.next_id); }
  /// Spawns a walker with this id, which must be free.
  std::uint32_t spawn(const Spawn& spawn, std::uint32_t id);
  void remove(std::uint32_t id);
  /// Also throws if walls leave no way from the walker to the goal.
  void checkGoal(std::uint32_t id, const Point& goal);
  void setGoal(std::uint32_t id, const Point& goal);
  void setWandering(std::uint32_t id);
  /// Adds or moves a robot.
  void setRobot(const Robot& robot);
  void removeRobot(const std::string& id);
  void setSettings(const CrowdSettings& settings);
  /// Removes all walkers; ids start again.
  void clear();

  /// Removes the walkers whose places another shard owns, and returns them by rising id.
  std::vector<Walker> takeOutside(const CrowdOwners& owners);
  /// Adds a walker that has left another shard. @throws InvalidInput if its id is not free, or
  /// MOST_WALKERS are there.
  void takeIn(const Walker& walker);
  /// Gives no id up to this one to walkers that are spawned without an id.
  void keepIdsFree(std::uint32_t id) {
    memory_.next_id = std::max(memory_.next_id, std::min(id, LARGEST_ID) + 1);
  }
  /// Sets the walkers of other shards, by rising id, that those of this one see in the next tick.
  /// No id may be that of a walker here.
  void setOthers(std::vector<Walker> others) { others_ = std::move(others); }

  /// Advances by one tick. A stamp that is not later moves no walker.
  void advance(Nanoseconds stamp);

  const CrowdSnapshot& snapshot() const { return memory_; }
  void restore(CrowdSnapshot memory);
  /// The snapshot as bytes, and back with all stamps moved by `shift`. @throws InvalidInput for
  /// bytes that are no state of a crowd.
  std::string archived() const;
  static CrowdSnapshot readArchived(std::string bytes, Nanoseconds shift = 0);
  const std::vector<Walker>& walkers() const { return memory_.walkers; }
  /// Returns null for an unknown id.
  const Walker* find(std::uint32_t id) const;
  const ObstacleGrid& obstacles() const { return still_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  /// Returns the largest overlap of outlines [m]; 0: none. For tests and diagnostics.
  double deepestOverlap() const;
  const Ways& ways() const { return ways_; }

 private:
  struct Tick;
  /// @throws InvalidInput unless there is room for a walker with this id.
  void checkRoom(const char* context, std::uint32_t id) const;
  static constexpr std::size_t NOT_HERE = SIZE_MAX;
  std::size_t indexOf(std::uint32_t id) const;
  Walker& at(std::uint32_t id);
  void updateSurroundings();
  void mergeOthers();
  void findAims();
  Wish wishOf(Walker& walker, const Point& front, std::size_t index) const;
  void stepOne(std::size_t index, std::uint32_t rank, const Tick& tick, Walker& walker) const;
  void keepSide(int taken, double dt, Walker& walker) const;
  void loosen(double wanted, const Tick& tick, Walker& walker) const;
  void reach(const Tick& tick, Walker& walker) const;
  void chooseGoal(Walker& walker) const;
  template <class Each>
  void forAll(std::size_t count, Each each) const;

  std::shared_ptr<const terrain::HeightMap> terrain_;
  ObstacleGrid still_;
  Ways ways_;
  Resistance resistance_;
  std::shared_ptr<ThreadPool> threads_{std::make_shared<ThreadPool>()};
  CrowdSnapshot memory_;
  std::vector<Walker> others_;      ///< of other shards, by rising id
  std::vector<Walker> all_;         ///< walkers and others_, by rising id; empty without others
  std::vector<std::size_t> index_;  ///< of the walkers in all_, NOT_HERE of others
  WalkerGrid grid_;                 ///< positions of all at the last tick
  std::vector<Obstacle> robots_;
  std::vector<WayQuery> queries_;  ///< walkers on a detour
  std::vector<Point> aims_;        ///< goal of each walker, or where its detour leads now
};

}  // namespace vegetation_sim::crowd

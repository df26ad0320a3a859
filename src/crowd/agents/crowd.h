// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crowd/agents/walking_speed.h"
#include "crowd/geometry/ways.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::crowd {

/// Rectangle in which walkers that wander choose their goals [m].
struct Area {
  double min_x{-10.0}, max_x{10.0}, min_y{-10.0}, max_y{10.0};
};
void describe(FieldVisitor& visitor, Area& area);

/// All that has memory in a crowd: copy it to save, assign it to restore (N6). What stands still,
/// the terrain and the grass are inputs; with the same ones, what follows is the same to the bit.
struct CrowdSnapshot {
  Nanoseconds stamp{0};
  bool begun{false};  ///< `stamp` is of a tick
  std::uint64_t seed{0};
  CrowdSettings settings;
  Area area;
  std::vector<Walker> walkers;          ///< ids rising
  std::map<std::string, Robot> robots;  ///< by id
  std::uint32_t next_id{0};

  std::uint64_t hash() const;
};

/// How hard the ground is to walk on at a place: 0 free to 1 the densest grass.
using Resistance = std::function<double(const Point&)>;

/// Most walkers of a crowd, most robots among them.
constexpr std::size_t MOST_WALKERS = 100000, MOST_ROBOTS = 64;

/// Walkers who see, decide and move (paper 2, section 5; S2-30). Inputs take effect at the next
/// tick. Each walker looks at the crowd as it was, so the order in which they are stepped, and on
/// how many threads, changes nothing. Not thread-safe itself.
class Crowd {
 public:
  /// @throws InvalidInput with all faults of the settings.
  Crowd(std::uint64_t seed, const CrowdSettings& settings, const Area& area,
        std::shared_ptr<const terrain::HeightMap> terrain);

  /// Trunks and walls, instead of the former ones.
  void setObstacles(std::vector<Obstacle> obstacles);
  /// Asked from several threads.
  void setResistance(Resistance resistance) { resistance_ = std::move(resistance); }
  void setThreads(int threads) { threads_ = std::max(1, threads); }

  // Each throws InvalidInput naming thing, value and range, and then changes nothing.
  /// With the next free id.
  std::uint32_t spawn(const Spawn& spawn) { return this->spawn(spawn, memory_.next_id); }
  /// With this one, which nobody may have.
  std::uint32_t spawn(const Spawn& spawn, std::uint32_t id);
  void remove(std::uint32_t id);
  /// @throws also where walls leave no way from the walker to the goal.
  void checkGoal(std::uint32_t id, const Point& goal);
  void setGoal(std::uint32_t id, const Point& goal);
  void setWandering(std::uint32_t id);
  /// Where a robot is now.
  void setRobot(const Robot& robot);
  void removeRobot(const std::string& id);
  void setSettings(const CrowdSettings& settings);
  /// Nobody is left; ids begin anew.
  void clear();

  /// One tick. A stamp not after the last moves nobody.
  void advance(Nanoseconds stamp);

  const CrowdSnapshot& snapshot() const { return memory_; }
  void restore(CrowdSnapshot memory);
  const std::vector<Walker>& walkers() const { return memory_.walkers; }
  /// Null if unknown.
  const Walker* find(std::uint32_t id) const;
  const ObstacleGrid& obstacles() const { return still_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  /// Farthest that any outlines overlap now [m]; 0: none. For tests and diagnostics.
  double deepestOverlap() const;

 private:
  struct Tick;
  std::size_t indexOf(std::uint32_t id) const;
  Walker& at(std::uint32_t id);
  void look();
  Wish wishOf(Walker& walker, const Point& front, std::size_t index) const;
  void stepOne(std::size_t index, const Tick& tick, Walker& walker) const;
  void keepSide(int taken, double dt, Walker& walker) const;
  void loosen(double wanted, const Tick& tick, Walker& walker) const;
  void reach(const Tick& tick, Walker& walker) const;
  void chooseGoal(Walker& walker) const;
  double paceAt(const Walker& walker, const Point& direction) const;
  template <class Each>
  void forAll(std::size_t count, Each each) const;

  std::shared_ptr<const terrain::HeightMap> terrain_;
  ObstacleGrid still_;
  Ways ways_;
  Resistance resistance_;
  int threads_{1};
  CrowdSnapshot memory_;
  WalkerGrid grid_;  ///< all as they were at the last tick
  std::vector<Obstacle> robots_;
  std::vector<const FlowField*> fields_;  ///< of each walker that makes a detour
};

}  // namespace vegetation_sim::crowd

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "core/threads/thread_pool.h"
#include "scenes/canopy_part.h"
#include "scenes/crowd_part.h"
#include "scenes/forest_part.h"
#include "scenes/grass_part.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::scenes {

/// Simulates everything that a scenario describes, tick by tick. What a scenario lacks is null.
class World {
 public:
  /// @param threads that the forest, the crowd and the scanner may use; results do not depend on
  /// it.
  explicit World(const std::string& scenario, int threads = 1);

  /// Advances everything to the next tick.
  void advance();
  int tick() const { return tick_; }
  /// Sets the number of the present tick, for a world whose state is restored from a snapshot.
  void setTick(int tick) { tick_ = tick; }
  Nanoseconds now() const { return grid_.timeOf(first_ + tick_); }
  /// Stamp of the coming tick, which events before it bear.
  Nanoseconds next() const { return grid_.timeOf(first_ + tick_ + 1); }
  /// Seconds from the start to the coming tick.
  double nextSeconds() const { return secondsBetween(START, next()); }
  void addTo(Hashes& hashes);

  /// Replaces the wind by `later_wind` of the scenario, for all.
  void changeWind();
  /// Places the camera that levels of detail and layers are chosen for; it looks horizontally.
  void setCamera(const Vec3& from, double yaw);
  /// Places the sensor within whose range [m] trees move with at most an error [m].
  void setSensor(const Vec3& place, double range, double tolerance);

  std::unique_ptr<ForestPart> forest;
  std::unique_ptr<GrassPart> grass;
  std::unique_ptr<CanopyPart> canopy;
  std::unique_ptr<CrowdPart> crowd;

 private:
  void addScan(Hash& hash);

  Scenario scenario_;
  ThreadPool threads_;
  TickGrid grid_;
  std::int64_t first_;
  int tick_{0};
};

}  // namespace vegetation_sim::scenes

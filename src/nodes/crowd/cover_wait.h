// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "nodes/base/wait_backoff.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Which cover maps of a meadow a crowd awaits: one of its first tick, as if the meadow began with
/// it, and one of the first tick of each period.
class CoverWait {
 public:
  /// Time between the tick of a cover map and the tick at which all shards apply it.
  static constexpr Nanoseconds LEAD = NANOSECONDS_PER_SECOND / 5;

  /// @param rate of the maps. @param tick_rate of the nodes [Hz].
  CoverWait(double rate, int tick_rate) : rate_(rate), grid_(tick_rate) {}

  /// To be called at each tick.
  void begin(Nanoseconds tick);
  /// Takes the stamp of a map. @param now stamp of the tick. @return false if the map is void: it
  /// was made before the clock jumped back, or before the state was loaded.
  bool hear(Nanoseconds stamp, Nanoseconds now);
  /// Whether the newest map of this tick or an earlier one has come, or none is due.
  bool hasMapOf(Nanoseconds tick) const;
  /// Ends the wait of a tick. @return whether a map was awaited in vain.
  bool endWait(bool has_come) { return backoff_.endWait(has_come); }
  /// Awaits the maps of a meadow that starts afresh, because the clock has jumped back. Those of a
  /// stamp later than the tick are void until one is not.
  void jumpBack();
  /// Awaits the maps after this tick: those that are still to come of the time before it are void,
  /// since the state that was loaded has its own.
  void onLoaded(Nanoseconds tick);

 private:
  std::int64_t periodOfMap(Nanoseconds stamp) const;

  double rate_;
  TickGrid grid_;
  std::optional<Nanoseconds> first_;   // tick that may have a map
  std::optional<Nanoseconds> newest_;  // map that has come, or tick that needs none
  std::optional<Nanoseconds> loaded_;  // tick of the state
  bool has_jumped_back_{false};        // and no map has come since then
  WaitBackoff backoff_;
};

}  // namespace vegetation_sim

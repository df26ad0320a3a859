// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrabStatuses.h>

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "forest/forest.h"

namespace vegetation_sim {

/// Which grabs are in force, since when, and why the latest ones have ended.
class GrabHistory {
 public:
  static constexpr std::size_t MOST_ENDED = 64;

  /// Says why a grab ends before the next update. Without a reason it ends by its lease.
  void explain(std::uint32_t id, std::uint8_t reason) { reasons_[id] = reason; }
  /// Says why all grabs in force end.
  void explainAll(std::uint8_t reason);
  /// Records a grab that never was in force at an update, with the reason explained before, if
  /// there is one.
  void addUnheld(std::uint32_t id, std::uint8_t reason, Nanoseconds stamp);
  /// After a tick: compares the grabs in force with those of the last call. @return whether any
  /// grab has begun or ended.
  bool update(const forest::HeldGrabs& held, Nanoseconds stamp);
  /// Returns why a grab has ended, in words that follow "id = 1"; empty if that is not known, or
  /// not any more.
  std::string describeEnd(std::uint32_t id) const;
  /// The part of a saved state that is kept besides the grabs in force.
  struct State {
    std::map<std::uint32_t, Nanoseconds> since;  ///< of the grabs in force
    std::vector<GrabStatus> ended;
  };
  State state() const;
  void restore(const State& state, const forest::HeldGrabs& held);
  /// The grabs in force and those that ended. Left to the caller: the frame of the header.
  GrabStatuses message(Nanoseconds stamp) const;

 private:
  struct Held {
    forest::Grab grab;
    Nanoseconds since;
  };
  void addEnded(GrabStatus status);

  std::map<std::uint32_t, Held> held_;
  std::map<std::uint32_t, std::uint8_t> reasons_;  // of grabs that end
  std::deque<GrabStatus> ended_;
  bool changed_{false};
};

}  // namespace vegetation_sim

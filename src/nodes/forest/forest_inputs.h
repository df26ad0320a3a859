// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ForestEvent.h>

#include <string>
#include <vector>

#include "forest/forest.h"
#include "nodes/base/event_queue.h"

namespace vegetation_sim {

/// Everything that can be reconfigured while forest_animator runs: levels, transitions and the
/// designer's factors on every species (S1-10).
struct ForestTuning {
  forest::Settings settings;
  forest::Design design;
  double transition{1.0};  ///< [s]
};
void describe(FieldVisitor& visitor, ForestTuning& tuning);

/// An accepted input of forest_animator and the tick at which it takes effect.
struct ForestInput {
  /// Values of ForestEvent::kind.
  enum Kind : std::uint8_t {
    SENSOR,
    WIND,
    SETTINGS,
    RESET,
    GRAB,
    MOVE,
    RELEASE,
    FORCE,
    BODY,
    REMOVE_BODY,
    RENEW,
    LOAD,
    CUT
  };
  std::uint8_t kind{SENSOR};
  Nanoseconds stamp{0};   ///< 0: the next tick
  forest::Sensor sensor;  ///< SENSOR: in the world frame
  std::uint64_t wind_hash{0};
  std::vector<std::string> names;  ///< SETTINGS: all fields of ForestTuning
  std::vector<double> values;
  forest::Grab grab;        ///< GRAB: all of it; MOVE: id, target and holder; RELEASE, RENEW: id
  forest::Push push;        ///< FORCE: from 0 until its duration
  forest::Body body;        ///< BODY: all of it; REMOVE_BODY: id
  LoadedSnapshot snapshot;  ///< LOAD
  forest::BranchCut cut;    ///< CUT
};
inline Nanoseconds stampOf(const ForestInput& input) {
  return input.stamp;
}
inline void setStamp(ForestInput& input, Nanoseconds stamp) {
  input.stamp = stamp;
}
ForestEvent eventToMsg(const ForestInput& input);
/// @throws InvalidInput for a force whose duration is out of range.
ForestInput eventFromMsg(const ForestEvent& message);

/// Applies a grab, its move, renewal or release, a force, a cut or a body to the forest. @throws
/// InvalidInput, and then nothing has changed, also for another kind.
void applyInteraction(const ForestInput& input, forest::Forest& forest);

/// Tuning from the names and values of an input. @throws InvalidInput for an unknown name or a
/// value out of range.
ForestTuning tuningOf(const ForestInput& input);

/// The queue of forest_animator. An input replaces an earlier one that it makes void at its tick.
class ForestInputs : public EventQueue<ForestInput, ForestEvent> {
 public:
  using EventQueue::EventQueue;

  /// Adds an input, or replaces an earlier wind, tuning or reset, or for the same stamp an earlier
  /// message of the same sensor, move or renewal of the same grab. Winds, settings and
  /// resets are added even if the queue is full. @return false if the queue is full.
  bool add(const ForestInput& input);
  /// Returns a grab that waits for its tick; null if there is none.
  const forest::Grab* waitingGrab(std::uint32_t id) const;
  /// Drops what waits about a grab.
  void forgetGrab(std::uint32_t id);
};

}  // namespace vegetation_sim

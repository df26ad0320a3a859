// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ForestEvent.h>
#include <vegetation_sim/WindField.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
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

/// Names and values of all fields, and back. @throws InvalidInput for an unknown name or a value
/// out of range.
void toEvent(const ForestTuning& tuning, ForestEvent& event);
ForestTuning tuningOf(const ForestEvent& event);

/// Inputs wait here for the next tick. Live, each becomes an event stamped with the tick at which
/// it is applied; in a replay the recorded events are applied at their own ticks instead.
class ForestInputs {
 public:
  static constexpr std::size_t MOST_WAITING = 10000;

  explicit ForestInputs(bool replay) : replay_(replay) {}

  bool replay() const { return replay_; }
  // Live inputs, already checked. Without effect in a replay.
  void addViewer(const Viewer& viewer_in_world);
  void addTuning(const ForestTuning& tuning);
  void addReset();
  /// A grab, move, renewal, release or force; a stamp says when, zero: at the next tick. Of the
  /// moves of one grab at one tick only the last counts. @throws InvalidInput if too many wait.
  void addInteraction(const ForestEvent& event);
  /// For the next tick, before all that waits, however much: what grabs in force and bodies do by
  /// themselves.
  void addFirst(const ForestEvent& event);
  /// Forgets what waits about a grab.
  void forgetGrab(std::uint32_t id);
  /// A checked wind; in a replay it is kept until an event asks for it.
  void addWind(wind::Field wind);
  /// A recorded event; ignored live, since it is the node's own.
  void addEvent(const ForestEvent& event);

  /// Events that take effect at the tick `stamp`, in order, stamped with it. A recorded event that
  /// comes after its own tick is among them, and counted: from there on the replay differs. Live
  /// events of winds are only complete with windOf().
  std::vector<ForestEvent> take(Nanoseconds stamp);
  /// The wind that an event adopts; none if it was never heard.
  std::optional<wind::Field> windOf(const ForestEvent& event) const;
  const QueueLosses& losses() const { return losses_; }
  /// Time went back to `now`: live, only settings, winds and resets still wait; in a replay, events
  /// stamped later are forgotten.
  void startAnew(Nanoseconds now);

 private:
  void addLast(const ForestEvent& event);

  bool replay_;
  QueueLosses losses_;
  std::deque<ForestEvent> waiting_;
  std::map<std::uint64_t, wind::Field> winds_;  // by hash
  std::deque<std::uint64_t> wind_order_;
};

}  // namespace vegetation_sim

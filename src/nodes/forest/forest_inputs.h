// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ForestEvent.h>

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

/// Names and values of the fields in an event. @throws InvalidInput for an unknown name or a value
/// out of range.
ForestTuning tuningOf(const ForestEvent& event);

/// The queue of forest_animator. An input replaces an earlier one that it makes void at its tick.
class ForestInputs : public EventQueue<ForestEvent> {
 public:
  using EventQueue::EventQueue;

  /// Of winds, settings, resets and the poses of one viewer only the last counts, as does the last
  /// move and the last renewal of a grab for the same stamp. Winds, settings and resets are added
  /// even if the queue is full. @return false if the queue is full.
  bool add(const ForestEvent& event);
  /// Drops what waits about a grab.
  void forgetGrab(std::uint32_t id);
};

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_inputs.h"

#include <algorithm>

#include "core/config/field_values.h"

namespace vegetation_sim {
namespace {

bool isInteraction(const ForestEvent& event) {
  return event.kind >= ForestEvent::GRAB;
}

// Whether `event` makes the waiting event void.
bool replaces(const ForestEvent& event, const ForestEvent& waiting) {
  if (event.kind != waiting.kind) return false;
  if (!isInteraction(event)) return event.viewer.id == waiting.viewer.id;
  return (event.kind == ForestEvent::MOVE || event.kind == ForestEvent::RENEW) &&
         event.header.stamp == waiting.header.stamp && event.grab.id == waiting.grab.id;
}

}  // namespace

void describe(FieldVisitor& v, ForestTuning& t) {
  describe(v, t.settings);
  describe(v, t.design);
  v.number("transition", t.transition, "s", {0.01, 60.0});
}

ForestTuning tuningOf(const ForestEvent& event) {
  return fromNamedValues<ForestTuning>({event.names, event.values});
}

bool ForestInputs::add(const ForestEvent& event) {
  if (replay_) return true;
  for (ForestEvent& waiting : waiting_)
    if (replaces(event, waiting)) {
      waiting = event;
      return true;
    }
  const bool bounded = isInteraction(event) || event.kind == ForestEvent::VIEWER;
  if (bounded && room() == 0) {
    losses_.lost += event.kind == ForestEvent::VIEWER;  // a request gets an error instead
    return false;
  }
  waiting_.push_back(event);
  return true;
}

void ForestInputs::forgetGrab(std::uint32_t id) {
  forget([&](const ForestEvent& event) { return event.grab.id == id; });  // 0 in all other kinds
}

}  // namespace vegetation_sim

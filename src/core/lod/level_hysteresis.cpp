// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/level_hysteresis.h"

#include <utility>

namespace vegetation_sim {
namespace {

bool rests(Nanoseconds since, Nanoseconds stamp) {
  return secondsBetween(since, stamp) < RUNG_REST;
}

}  // namespace

Balance HeldRungs::govern(std::vector<Choice>& choices, int finest, double room, double tolerance,
                          Nanoseconds stamp) {
  if (stamp < stamp_) held_.clear();
  stamp_ = stamp;
  recall(choices, stamp);
  for (Choice& choice : choices)
    choice.stair = choice.wanted = rungWithin(choice, finest, tolerance);
  const Balance out = vegetation_sim::govern(choices, room, tolerance);
  keep(choices, stamp);
  return out;
}

void HeldRungs::recall(std::vector<Choice>& choices, Nanoseconds stamp) const {
  auto held = held_.begin();
  for (Choice& choice : choices) {
    while (held != held_.end() && held->id < choice.id) ++held;
    if (held == held_.end() || held->id != choice.id) continue;
    choice.held = held->rung;
    choice.resting = rests(held->since, stamp);
  }
}

void HeldRungs::keep(const std::vector<Choice>& choices, Nanoseconds stamp) {
  std::vector<Held> now;
  now.reserve(held_.size());
  auto before = held_.begin();
  for (const Choice& choice : choices) {
    while (before != held_.end() && before->id < choice.id) ++before;
    const bool known = before != held_.end() && before->id == choice.id;
    if (!known && choice.chosen == 0) continue;
    const bool same = known && before->rung == choice.chosen;
    const Held held{choice.id, choice.chosen, same ? before->since : stamp};
    if (held.rung > 0 || rests(held.since, stamp)) now.push_back(held);
  }
  held_ = std::move(now);
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/tier_hysteresis.h"

#include <utility>

namespace vegetation_sim {
namespace {

bool rests(Nanoseconds since, Nanoseconds stamp) {
  return secondsBetween(since, stamp) < TIER_HOLD;
}

}  // namespace

TierAllocation TierHysteresis::allocateTiers(std::vector<TierChoice>& choices, int finest,
                                             double room, double tolerance, Nanoseconds stamp) {
  if (stamp < stamp_) held_.clear();
  stamp_ = stamp;
  recall(choices, stamp);
  for (TierChoice& choice : choices)
    choice.stepwise = choice.wanted = tierWithin(choice, finest, tolerance);
  const TierAllocation out = vegetation_sim::allocateTiers(choices, room, tolerance);
  keep(choices, stamp);
  return out;
}

void TierHysteresis::recall(std::vector<TierChoice>& choices, Nanoseconds stamp) const {
  auto held = held_.begin();
  for (TierChoice& choice : choices) {
    while (held != held_.end() && held->id < choice.id) ++held;
    if (held == held_.end() || held->id != choice.id) continue;
    choice.held = held->tier;
    choice.resting = rests(held->since, stamp);
  }
}

void TierHysteresis::keep(const std::vector<TierChoice>& choices, Nanoseconds stamp) {
  std::vector<Held> now;
  now.reserve(held_.size());
  auto before = held_.begin();
  for (const TierChoice& choice : choices) {
    while (before != held_.end() && before->id < choice.id) ++before;
    const bool known = before != held_.end() && before->id == choice.id;
    if (!known && choice.chosen == 0) continue;
    const bool same = known && before->tier == choice.chosen;
    const Held held{choice.id, choice.chosen, same ? before->since : stamp};
    if (held.tier > 0 || rests(held.since, stamp)) now.push_back(held);
  }
  held_ = std::move(now);
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/common/held_rungs.h"

namespace vegetation_sim {

void HeldRungs::recall(Choice& choice, Nanoseconds stamp) const {
  const auto found = held_.find(choice.id);
  if (found == held_.end()) return;
  choice.held = found->second.rung;
  const double age = secondsBetween(found->second.since, stamp);
  choice.resting = age >= 0.0 && age < RUNG_REST;  // below 0: time went back
}

void HeldRungs::keep(const std::vector<Choice>& choices, Nanoseconds stamp) {
  std::map<std::uint32_t, Held> now;
  for (const Choice& choice : choices) {
    const auto before = held_.find(choice.id);
    const bool same = before != held_.end() && before->second.rung == choice.chosen;
    now[choice.id] = {choice.chosen, same ? before->second.since : stamp};
  }
  held_ = std::move(now);
}

}  // namespace vegetation_sim

// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/tread_senders.h"

#include <algorithm>

namespace vegetation_sim {

bool TreadSenders::hear(const std::string& sender, Nanoseconds sent, Nanoseconds complete,
                        Nanoseconds now) {
  const auto found = senders_.find(sender);
  if (found != senders_.end() && !found->second.has_jumped_back) {
    if (sent > now) return false;
    found->second.has_jumped_back = true;
  }
  if (complete == 0) return true;
  if (found != senders_.end() || senders_.size() < MOST_SENDERS)
    senders_[sender] = {sent, complete, true};
  return sent > loaded_;
}

bool TreadSenders::haveSent(Nanoseconds tick) const {
  return std::all_of(senders_.begin(), senders_.end(),
                     [&](const auto& entry) { return entry.second.sent >= tick; });
}

bool TreadSenders::areComplete(Nanoseconds stamp) const {
  return std::all_of(senders_.begin(), senders_.end(),
                     [&](const auto& entry) { return entry.second.complete_until >= stamp; });
}

std::size_t TreadSenders::forgetLate(Nanoseconds stamp) {
  std::size_t out = 0;
  for (auto entry = senders_.begin(); entry != senders_.end();) {
    const bool is_late = entry->second.complete_until < stamp;
    entry = is_late ? senders_.erase(entry) : std::next(entry);
    out += is_late;
  }
  return out;
}

void TreadSenders::jumpBack() {
  for (auto& entry : senders_) entry.second = {0, 0, false};
  loaded_ = 0;
}

}  // namespace vegetation_sim

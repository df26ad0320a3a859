// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/treads/tread_senders.h"

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
    senders_[sender] = {sent, complete};
  return sent > loaded_;
}

bool TreadSenders::haveSent(Nanoseconds tick) const {
  return std::all_of(senders_.begin(), senders_.end(), [&](const auto& entry) {
    return !entry.second.is_awaited || entry.second.sent >= tick;
  });
}

bool TreadSenders::areComplete(Nanoseconds stamp) const {
  return std::all_of(senders_.begin(), senders_.end(), [&](const auto& entry) {
    return !entry.second.is_awaited || entry.second.complete_until >= stamp;
  });
}

std::size_t TreadSenders::giveUp(Nanoseconds stamp) {
  std::size_t out = 0;
  for (auto& [name, sender] : senders_) {
    if (!sender.is_awaited || sender.complete_until >= stamp) continue;
    sender.is_awaited = false;
    ++out;
  }
  return out;
}

void TreadSenders::jumpBack() {
  for (auto& [name, sender] : senders_) {
    sender.complete_until = sender.sent = 0;
    sender.has_jumped_back = false;
  }
  loaded_ = 0;
}

}  // namespace vegetation_sim

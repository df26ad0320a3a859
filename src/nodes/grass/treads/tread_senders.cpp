// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/treads/tread_senders.h"

#include <algorithm>

namespace vegetation_sim {

bool TreadSenders::hear(const std::string& sender, Nanoseconds sent, Nanoseconds complete,
                        Nanoseconds now) {
  if (senders_.size() >= MOST_SENDERS && senders_.count(sender) == 0) return true;
  Sender& heard = senders_[sender];
  if (!heard.has_jumped_back && sent > now) return false;
  heard.has_jumped_back = true;
  heard.sent = sent;
  heard.complete_until = complete;
  heard.says_so = complete != 0;
  heard.backoff.onMessage();
  return !heard.says_so || sent > loaded_;
}

bool TreadSenders::areComplete(Nanoseconds stamp) const {
  return std::all_of(senders_.begin(), senders_.end(), [&](const auto& entry) {
    return !entry.second.isAwaited() || entry.second.complete_until >= stamp;
  });
}

bool TreadSenders::haveSent(Nanoseconds tick) const {
  return std::all_of(senders_.begin(), senders_.end(), [&](const auto& entry) {
    return !entry.second.isAwaited() || entry.second.sent >= tick;
  });
}

std::size_t TreadSenders::endWait(Nanoseconds stamp) {
  std::size_t out = 0;
  for (auto& [name, sender] : senders_)
    out += sender.says_so && sender.backoff.endWait(sender.complete_until >= stamp);
  return out;
}

void TreadSenders::jumpBack() {
  for (auto& [name, sender] : senders_) {
    sender.sent = sender.complete_until = 0;
    sender.has_jumped_back = false;
  }
  loaded_ = 0;
}

}  // namespace vegetation_sim

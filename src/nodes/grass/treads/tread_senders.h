// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "nodes/base/wait_backoff.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Nodes that send TreadEvents. A tick can await those that say up to which stamp they have sent
/// their treads.
class TreadSenders {
 public:
  static constexpr std::size_t MOST_SENDERS = 1000;  ///< those beyond are not awaited

  /// Takes what a message says. @param sent stamp of the message. @param complete its
  /// `complete_until`; 0: it does not say. @param now stamp of the tick.
  /// @return false if the message is void, since its sender has sent it before the clock jumped
  /// back, or before the state was loaded.
  bool hear(const std::string& sender, Nanoseconds sent, Nanoseconds complete, Nanoseconds now);
  /// Whether all treads that act at this stamp have come.
  bool areComplete(Nanoseconds stamp) const;
  /// Whether all messages of this tick have come.
  bool haveSent(Nanoseconds tick) const;
  /// Ends the wait of a tick. @return number of nodes that were awaited in vain.
  std::size_t endWait(Nanoseconds stamp);
  /// Awaits all of them afresh, because the clock has jumped back. Messages of a stamp later than
  /// the tick are void until one of their sender is not.
  void jumpBack();
  /// Messages that are still to come of the time up to this tick are void if their sender is
  /// awaited, since the state that was loaded has the treads of that time.
  void onLoaded(Nanoseconds tick) { loaded_ = tick; }

 private:
  struct Sender {
    Nanoseconds sent{0}, complete_until{0};
    bool says_so{false};         // up to which stamp it has sent its treads
    bool has_jumped_back{true};  // like the clock of this node
    WaitBackoff backoff{};
    bool isAwaited() const { return says_so && backoff.isAwaited(); }
  };
  std::map<std::string, Sender> senders_;
  Nanoseconds loaded_{0};  // tick of the state
};

}  // namespace vegetation_sim

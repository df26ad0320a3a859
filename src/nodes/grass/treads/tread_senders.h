// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Nodes that say up to which stamp they have sent their treads, so that a tick can await those of
/// each of them. A node that does not say so is never awaited.
class TreadSenders {
 public:
  static constexpr std::size_t MOST_SENDERS = 1000;  ///< those beyond are not awaited

  /// Takes what a message of TreadEvents says. @param sent stamp of the message. @param complete
  /// its `complete_until`; 0: it does not say. @param now stamp of the tick that awaits it.
  /// @return false if the message is void, since its sender has sent it before the clock jumped
  /// back, or before the state was loaded.
  bool hear(const std::string& sender, Nanoseconds sent, Nanoseconds complete, Nanoseconds now);
  /// Whether all that act at this stamp have come.
  bool areComplete(Nanoseconds stamp) const;
  /// Whether all have sent their message of this tick.
  bool haveSent(Nanoseconds tick) const;
  /// Awaits those who have not sent what acts at this stamp no more, until they send again.
  /// @return their number
  std::size_t giveUp(Nanoseconds stamp);
  /// Awaits all of them afresh, because the clock has jumped back. Messages of a stamp later than
  /// the tick are void until one of their sender is not.
  void jumpBack();
  /// Messages that are still to come of the time up to this tick are void, since the state that was
  /// loaded has the treads that were sent before.
  void onLoaded(Nanoseconds tick) { loaded_ = tick; }

 private:
  struct Sender {
    Nanoseconds sent{0}, complete_until{0};
    bool is_awaited{true};
    bool has_jumped_back{true};  // like the clock of this node
  };
  Nanoseconds loaded_{0};  // tick of the state
  std::map<std::string, Sender> senders_;
};

}  // namespace vegetation_sim

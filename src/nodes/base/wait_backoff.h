// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace vegetation_sim {

/// Tells whether ticks await the messages of another node. One that was awaited in vain is awaited
/// again once it has sent 1, 2, 4, ... at last MOST messages more, so that a node that is always
/// late delays few ticks.
class WaitBackoff {
 public:
  static constexpr int MOST = 64;

  bool isAwaited() const { return left_ == 0; }
  /// To be called for each message.
  void onMessage() { left_ -= left_ > 0; }
  /// Ends the wait of a tick. @param has_come whether the message has come in time.
  /// @return whether it was awaited in vain
  bool endWait(bool has_come) {
    if (!isAwaited()) return false;
    left_ = has_come ? 0 : pause_;
    pause_ = has_come ? 1 : std::min(2 * pause_, MOST);
    return !has_come;
  }

 private:
  int left_{0};   // messages to pass before the next wait
  int pause_{1};  // after the next wait in vain
};

}  // namespace vegetation_sim
